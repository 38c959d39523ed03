// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

// The drawing library: VTK's rendering lives here and nowhere else.

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkDataArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkScalarBarActor.h>
#include <vtkScalarsToColors.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkWarpVector.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Geometry>
#include <stdexcept>

#include "picture/colour_map.h"
#include "picture/draw_glyphs.h"
#include "picture/picture.h"
#include "picture/png.h"
#include "picture/virtual_display.h"

namespace palpate::app {
namespace {

constexpr double kInk[3] = {0.13, 0.13, 0.16}, kPaper[3] = {1, 1, 1};
constexpr double kFree[3] = {0.87, 0.73, 0.62}, kFixed[3] = {0.25, 0.42, 0.72};
constexpr double kNothing[3] = {0.78, 0.78, 0.8};  ///< where an array has no value

vtkSmartPointer<vtkPolyData> shapeOf(const View& view) {
  vtkNew<vtkPolyData> shape;
  shape->CopyStructure(view.surface);
  for (const std::string& name : {view.colourBy, std::string("BoundaryType")})
    if (vtkDataArray* array = view.surface->GetPointData()->GetArray(name.c_str()))
      shape->GetPointData()->AddArray(array);
    else if (vtkDataArray* ofCells = view.surface->GetCellData()->GetArray(name.c_str()))
      shape->GetCellData()->AddArray(ofCells);
  if (!view.deformed) return shape;
  shape->GetPointData()->SetVectors(view.surface->GetPointData()->GetArray("Displacement"));
  vtkNew<vtkWarpVector> warp;
  warp->SetInputData(shape);
  warp->Update();
  return vtkPolyData::SafeDownCast(warp->GetOutput());
}

/// Viridis over a range.
vtkSmartPointer<vtkScalarsToColors> viridisOver(std::array<double, 2> range, bool logarithmic) {
  vtkNew<vtkColorTransferFunction> colours;
  for (int i = 0; i < 9; ++i)
    colours->AddRGBPoint(i / 8.0, kViridis[i][0], kViridis[i][1], kViridis[i][2]);
  if (!(range[1] > range[0])) range[1] = range[0] + 1e-12 + 1e-6 * std::abs(range[0]);
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(256);
  for (int i = 0; i < 256; ++i) {
    const double* colour = colours->GetColor(i / 255.0);
    table->SetTableValue(i, colour[0], colour[1], colour[2]);
  }
  table->SetTableRange(range.data());
  table->SetNanColor(kNothing[0], kNothing[1], kNothing[2], 1);
  if (logarithmic) table->SetScaleToLog10();
  return table;
}

/// Colours and their range for a view's surface: an array by viridis, or fixed against free.
vtkSmartPointer<vtkScalarsToColors> coloursOf(const View& view, vtkDataArray* array) {
  if (view.colourBy.empty()) {
    vtkNew<vtkColorTransferFunction> colours;
    colours->AddRGBPoint(0, kFree[0], kFree[1], kFree[2]);
    colours->AddRGBPoint(1, kFixed[0], kFixed[1], kFixed[2]);
    return colours;
  }
  const bool isVector = array->GetNumberOfComponents() > 1;
  std::array<double, 2> range{0, 1};
  array->GetRange(range.data(), isVector ? -1 : 0);
  const auto colours = viridisOver(view.range.value_or(range), view.logarithmic);
  if (isVector) colours->SetVectorModeToMagnitude();
  return colours;
}

constexpr int kSharedBarPixels = 150;  ///< what a bar that all views share takes of the width

double largestIn(vtkScalarsToColors* colours) {
  return std::abs(colours->GetRange()[1]);
}

/// @param left, width  of the viewport.
void addBar(vtkRenderer* renderer, vtkScalarsToColors* colours, const std::string& title,
            double left, double width) {
  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(colours);
  bar->SetTitle(title.c_str());
  bar->SetNumberOfLabels(5);
  // Three digits, but thousands in full: exponents would not fit.
  const double largest = largestIn(colours);  // labels of more characters would not fit
  bar->SetLabelFormat(largest >= 1e3 && largest < 1e5 ? "%.0f" : largest < 0.1 ? "%.2g" : "%.3g");
  bar->SetVerticalTitleSeparation(12);
  bar->SetTextPad(6);
  bar->UnconstrainedFontSizeOn();
  bar->SetPosition(left, 0.12);
  bar->SetWidth(width);
  bar->SetHeight(0.72);
  for (vtkTextProperty* text : {bar->GetTitleTextProperty(), bar->GetLabelTextProperty()}) {
    text->SetColor(const_cast<double*>(kInk));
    text->ShadowOff();
    text->ItalicOff();
    text->BoldOff();
    text->SetFontSize(16);
  }
  renderer->AddActor2D(bar);
}

/// @return the colours of the array that is shown.
vtkSmartPointer<vtkScalarsToColors> addSurface(vtkRenderer* renderer, const View& view) {
  const vtkSmartPointer<vtkPolyData> shape = shapeOf(view);
  const std::string name = view.colourBy.empty() ? "BoundaryType" : view.colourBy;
  vtkDataArray* array = shape->GetPointData()->GetArray(name.c_str());
  const bool ofPoints = array;
  if (!ofPoints) array = shape->GetCellData()->GetArray(name.c_str());
  if (!array && !view.colourBy.empty())
    throw std::runtime_error("there is no array '" + view.colourBy + "' to colour by");

  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(shape);
  normals->SetFeatureAngle(50);
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetEdgeVisibility(view.hasEdges);
  actor->GetProperty()->SetEdgeColor(0.25, 0.25, 0.28);
  actor->GetProperty()->SetLineWidth(0.5);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.75);
  actor->GetProperty()->SetColor(const_cast<double*>(kFree));
  renderer->AddActor(actor);
  if (!array) return nullptr;
  const auto colours = coloursOf(view, array);
  if (ofPoints)
    mapper->SetScalarModeToUsePointFieldData();
  else
    mapper->SetScalarModeToUseCellFieldData();
  mapper->SelectColorArray(name.c_str());
  mapper->SetColorModeToMapScalars();  // bytes are values too, not colours
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  if (ofPoints) mapper->InterpolateScalarsBeforeMappingOn();
  return colours;
}

/// @param middle  of the line, of the viewport's width.
void addTitle(vtkRenderer* renderer, const std::string& title, double middle) {
  vtkNew<vtkTextActor> text;
  text->SetInput(title.c_str());
  text->GetTextProperty()->SetFontSize(20);
  text->GetTextProperty()->SetColor(const_cast<double*>(kInk));
  text->GetTextProperty()->SetJustificationToCentered();
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(middle, 0.93);
  renderer->AddActor2D(text);
}

/// Where the middle of what a view shows is, of its width.
double middleOf(const Picture& picture) {
  return picture.sharesBar ? 0.5 : 0.42;
}

/// Right, up and towards the viewer.
Eigen::Matrix3d axesFor(const std::array<double, 3>& towardsViewer) {
  const Eigen::Vector3d towards = Eigen::Vector3d(towardsViewer.data()).stableNormalized();
  const bool fromAbove = std::abs(towards.z()) > 0.95;
  const Eigen::Vector3d upwards = fromAbove ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;
  axes << upwards.cross(towards).normalized(), towards.cross(upwards.cross(towards)).normalized(),
      towards;
  return axes;
}

/// Of what a view shows, along axes.
Eigen::AlignedBox3d boxOf(const View& view, const Eigen::Matrix3d& axes) {
  Eigen::AlignedBox3d box;
  const auto shape = shapeOf(view);
  for (vtkIdType i = 0; i < shape->GetNumberOfPoints(); ++i)
    box.extend(axes.transpose() * Eigen::Vector3d(shape->GetPoint(i)));
  for (const Glyph& glyph : view.glyphs)
    box.extend(axes.transpose() * Eigen::Vector3d(glyph.place.data()));
  return box;
}

/// A camera a view, to one scale, so that they can be compared; those that have no direction of
/// their own are placed alike. It holds what they show in the left of a viewport, beside the colour
/// bar.
std::vector<vtkSmartPointer<vtkCamera>> camerasFor(const Picture& picture, double aspect) {
  // Of the viewport: middle and extent.
  const double left = middleOf(picture), width = picture.sharesBar ? 0.9 : 0.74, height = 0.78;
  std::vector<Eigen::Matrix3d> axes;
  std::vector<Eigen::AlignedBox3d> boxes;
  Eigen::AlignedBox3d common;
  for (const View& view : picture.views) {
    axes.push_back(axesFor(view.towardsViewer.value_or(picture.towardsViewer)));
    boxes.push_back(boxOf(view, axes.back()));
    if (!view.towardsViewer) common.extend(boxes.back());
  }
  double scale = 1e-300, depth = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!picture.views[i].towardsViewer) boxes[i] = common;
    const Eigen::Vector3d half = boxes[i].sizes() / 2;
    scale = std::max({scale, half.y() / height, half.x() / (width * aspect)});
    depth = std::max(depth, half.norm());
  }
  std::vector<vtkSmartPointer<vtkCamera>> cameras;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Eigen::Vector3d towards = axes[i].col(2), upwards = axes[i].col(1);
    const Eigen::Vector3d centre =
        axes[i] * (boxes[i].center() + Eigen::Vector3d((1 - 2 * left) * scale * aspect, 0, 0));
    const Eigen::Vector3d eye = centre + 4 * depth * towards;
    vtkNew<vtkCamera> camera;
    camera->SetFocalPoint(centre.data());
    camera->SetPosition(eye.data());
    camera->SetViewUp(upwards.data());
    camera->ParallelProjectionOn();
    camera->SetParallelScale(scale);
    camera->SetClippingRange(depth, 8 * depth);
    cameras.emplace_back(camera);
  }
  return cameras;
}

void draw(const Picture& picture, const std::string& path) {
  const VirtualDisplay display;
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(picture.width, picture.height);
  const double count = static_cast<double>(picture.views.size());
  const double right = picture.sharesBar ? 1 - double(kSharedBarPixels) / picture.width : 1;
  const auto cameras = camerasFor(picture, right * picture.width / count / picture.height);
  const auto addRenderer = [&](double from, double to) {
    vtkNew<vtkRenderer> renderer;
    renderer->SetViewport(from, 0, to, 1);
    renderer->SetBackground(const_cast<double*>(kPaper));
    renderer->SetUseFXAA(true);
    window->AddRenderer(renderer);
    return renderer.GetPointer();
  };
  for (std::size_t i = 0; i < picture.views.size(); ++i) {
    const View& view = picture.views[i];
    vtkRenderer* renderer = addRenderer(right * i / count, right * (i + 1) / count);
    vtkSmartPointer<vtkScalarsToColors> colours = addSurface(renderer, view);
    addTitle(renderer, view.title, middleOf(picture));
    renderer->SetActiveCamera(cameras[i]);
    if (!view.glyphs.empty()) {
      if (view.colourBy.empty())
        colours = viridisOver(view.range.value_or(std::array<double, 2>{0, 1}), view.logarithmic);
      addGlyphs(renderer, view, colours);
    }
    if (view.colourBy.empty() && view.glyphs.empty()) continue;
    if (!picture.sharesBar)
      addBar(renderer, colours, view.barTitle, 0.83, 0.13);
    else if (i == 0)
      addBar(addRenderer(right, 1), colours, view.barTitle, 0.1, 0.8);
  }
  window->Render();
  writePng(window, path);
}

}  // namespace
}  // namespace palpate::app

extern "C" __attribute__((visibility("default"))) std::string palpate_draw_picture(
    const palpate::app::Picture& picture, const std::string& path) {
  try {
    palpate::app::draw(picture, path);
    return {};
  } catch (const std::exception& failure) {
    return failure.what();
  }
}
