// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "picture/draw_glyphs.h"

#include <vtkActor.h>
#include <vtkArrowSource.h>
#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkProperty.h>
#include <vtkRegularPolygonSource.h>
#include <vtkRenderer.h>
#include <vtkScalarsToColors.h>
#include <vtkSphereSource.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Core>

namespace palpate::app {
namespace {

constexpr double kInk[3] = {0.13, 0.13, 0.16}, kOutlier[3] = {0.85, 0.1, 0.1};
constexpr double kRing = 1.9, kWire = 0.25, kLift = 5;  ///< radii, of balls' radii
constexpr int kFont = 16;                               ///< pixels
constexpr double kLetter = 0.6;                         ///< width of a letter over the font's size
constexpr const char *kValue = "Value", *kArrow = "Arrow";

/// Glyphs of one kind, with or without a value.
vtkSmartPointer<vtkPolyData> chosen(const View& view, Glyph::Kind kind, bool hasValue) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> values, arrows;
  values->SetName(kValue);
  arrows->SetName(kArrow);
  arrows->SetNumberOfComponents(3);
  for (const Glyph& glyph : view.glyphs) {
    if (glyph.kind != kind || glyph.value.has_value() != hasValue) continue;
    points->InsertNextPoint(glyph.place.data());
    values->InsertNextValue(glyph.value.value_or(0));
    arrows->InsertNextTuple(glyph.arrow.data());
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(values);
  data->GetPointData()->AddArray(arrows);
  return data;
}

/// What one glyph of a kind looks like.
vtkSmartPointer<vtkPolyDataAlgorithm> sourceOf(Glyph::Kind kind, const View& view,
                                               const double towardsViewer[3]) {
  if (kind == Glyph::Kind::Ball) {
    vtkNew<vtkSphereSource> ball;
    ball->SetRadius(view.glyphRadius);
    ball->SetThetaResolution(20);
    ball->SetPhiResolution(20);
    return ball;
  }
  if (kind == Glyph::Kind::Arrow) {
    vtkNew<vtkArrowSource> arrow;
    arrow->SetShaftResolution(16);
    arrow->SetTipResolution(24);
    arrow->SetTipLength(0.4);
    arrow->SetTipRadius(0.13);
    arrow->SetShaftRadius(0.05);
    return arrow;
  }
  vtkNew<vtkRegularPolygonSource> ring;
  ring->GeneratePolygonOff();
  ring->SetNumberOfSides(32);
  ring->SetRadius(kRing * view.glyphRadius);
  ring->SetNormal(towardsViewer[0], towardsViewer[1], towardsViewer[2]);
  const double lift = kLift * view.glyphRadius;  // before what is around it
  ring->SetCenter(lift * towardsViewer[0], lift * towardsViewer[1], lift * towardsViewer[2]);
  vtkNew<vtkTubeFilter> wire;  // lines have the width of a pixel
  wire->SetInputConnection(ring->GetOutputPort());
  wire->SetRadius(kWire * view.glyphRadius);
  wire->SetNumberOfSides(8);
  return wire;
}

void addKind(vtkRenderer* renderer, const View& view, Glyph::Kind kind, bool hasValue,
             vtkScalarsToColors* colours) {
  const auto data = chosen(view, kind, hasValue);
  if (data->GetNumberOfPoints() == 0) return;
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceConnection(
      sourceOf(kind, view, renderer->GetActiveCamera()->GetViewPlaneNormal())->GetOutputPort());
  if (kind == Glyph::Kind::Arrow) {
    mapper->SetOrientationArray(kArrow);
    mapper->SetOrientationModeToDirection();
    mapper->SetScaleArray(kArrow);
    mapper->SetScaleModeToScaleByMagnitude();
  } else {
    mapper->ScalingOff();
  }
  mapper->SetScalarVisibility(hasValue);
  if (hasValue) {
    mapper->SetScalarModeToUsePointFieldData();
    mapper->SelectColorArray(kValue);
    mapper->SetLookupTable(colours);
    mapper->UseLookupTableScalarRangeOn();
  }
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(hasValue ? 0.45 : 1);
  actor->GetProperty()->SetDiffuse(hasValue ? 0.6 : 0);
  const double* colour = kind == Glyph::Kind::Ring ? kOutlier : kInk;
  actor->GetProperty()->SetColor(colour[0], colour[1], colour[2]);
  renderer->AddActor(actor);
}

/// Labels that keep clear of one another.
class Labels {
 public:
  explicit Labels(vtkRenderer* renderer) : renderer_(renderer) {}

  void add(const Glyph& glyph) {
    const Eigen::Vector3d foot(glyph.place.data()), arrow(glyph.arrow.data());
    const Eigen::Vector2d at = pixelsOf(foot), tip = pixelsOf(foot + arrow);
    const double width = kLetter * kFont * static_cast<double>(glyph.label.size());
    const Eigen::Vector2d half(0.5 * width + 2, 0.5 * kFont + 1);
    Eigen::Vector2d away = at - tip;
    if (!(away.norm() > 1)) away = Eigen::Vector2d::UnitY();
    const double begin = std::atan2(away.y(), away.x());
    for (double distance : {6., 16., 28., 42.})
      for (double turn : {0., 0.8, -0.8, 1.6, -1.6, 2.4, -2.4}) {
        const Eigen::Vector2d way(std::cos(begin + turn), std::sin(begin + turn));
        const Eigen::Vector2d middle =
            at + (distance + std::abs(way.x()) * half.x() + std::abs(way.y()) * half.y()) * way;
        if (tryAt(glyph.label, middle, half)) return;
      }
  }

 private:
  struct Place {
    Eigen::Vector2d middle, half;
  };

  Eigen::Vector2d pixelsOf(const Eigen::Vector3d& point) const {
    renderer_->SetWorldPoint(point.x(), point.y(), point.z(), 1);
    renderer_->WorldToDisplay();
    return {renderer_->GetDisplayPoint()[0], renderer_->GetDisplayPoint()[1]};
  }

  bool tryAt(const std::string& text, const Eigen::Vector2d& middle, const Eigen::Vector2d& half) {
    const int* origin = renderer_->GetOrigin();
    const int* size = renderer_->GetSize();
    const double heading = 0.9 * size[1];  // the title's line stays free
    if (middle.x() - half.x() < origin[0] || middle.x() + half.x() > origin[0] + size[0] ||
        middle.y() - half.y() < origin[1] || middle.y() + half.y() > origin[1] + heading)
      return false;
    for (const Place& other : taken_)
      if (((middle - other.middle).cwiseAbs().array() < (half + other.half).array()).all())
        return false;
    taken_.push_back({middle, half});
    vtkNew<vtkTextActor> label;
    label->SetInput(text.c_str());
    label->GetTextProperty()->SetFontSize(kFont);
    label->GetTextProperty()->SetColor(kInk[0], kInk[1], kInk[2]);
    label->GetTextProperty()->SetBackgroundColor(1, 1, 1);
    label->GetTextProperty()->SetBackgroundOpacity(0.7);
    label->GetTextProperty()->SetJustificationToCentered();
    label->GetTextProperty()->SetVerticalJustificationToCentered();
    label->GetPositionCoordinate()->SetCoordinateSystemToDisplay();
    label->SetPosition(middle.x(), middle.y());
    renderer_->AddActor2D(label);
    return true;
  }

  vtkRenderer* renderer_;
  std::vector<Place> taken_;
};

}  // namespace

void addGlyphs(vtkRenderer* renderer, const View& view, vtkScalarsToColors* colours) {
  for (Glyph::Kind kind : {Glyph::Kind::Ball, Glyph::Kind::Ring, Glyph::Kind::Arrow})
    for (bool hasValue : {false, true}) addKind(renderer, view, kind, hasValue, colours);
  Labels labels(renderer);
  for (const Glyph& glyph : view.glyphs)
    if (!glyph.label.empty()) labels.add(glyph);
}

}  // namespace palpate::app
