// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <vtkBrush.h>
#include <vtkContext2D.h>
#include <vtkContextActor.h>
#include <vtkContextItem.h>
#include <vtkContextScene.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkTextProperty.h>

#include <cstdlib>
#include <exception>

#include "picture/png.h"
#include "picture/virtual_display.h"
#include "report/drawing.h"

namespace palpate::app {
namespace {

constexpr double kScale = 2;  ///< pixels of the picture per pixel of the drawing

/// Paints a drawing, whose places are counted from above.
class DrawingItem : public vtkContextItem {
 public:
  vtkTypeMacro(DrawingItem, vtkContextItem);
  static DrawingItem* New();
  Drawing drawing;

  bool Paint(vtkContext2D* painter) override {
    for (const Drawing::Line& line : drawing.lines) paint(painter, line);
    for (const Drawing::Mark& mark : drawing.marks) paint(painter, mark);
    for (const Drawing::Label& label : drawing.labels) paint(painter, label);
    return true;
  }

 private:
  float x(double value) const { return static_cast<float>(kScale * value); }
  float y(double value) const { return static_cast<float>(kScale * (drawing.height - value)); }

  static vtkColor4ub colourOf(const std::string& text) {
    const long value = std::strtol(text.c_str() + 1, nullptr, 16);
    return vtkColor4ub(value >> 16 & 255, value >> 8 & 255, value & 255, 255);
  }

  void paint(vtkContext2D* painter, const Drawing::Line& line) const {
    painter->GetPen()->SetColor(colourOf(line.colour));
    painter->GetPen()->SetWidth(x(line.width));
    painter->GetPen()->SetLineType(line.isDashed ? vtkPen::DASH_LINE : vtkPen::SOLID_LINE);
    for (std::size_t i = 1; i < line.points.size(); ++i)
      painter->DrawLine(x(line.points[i - 1][0]), y(line.points[i - 1][1]), x(line.points[i][0]),
                        y(line.points[i][1]));
  }

  void paint(vtkContext2D* painter, const Drawing::Mark& mark) const {
    const vtkColor4ub colour = colourOf(mark.colour);
    const float outer = x(mark.radius), inner = mark.isHollow ? outer - x(1.5) : 0;
    painter->GetPen()->SetLineType(vtkPen::NO_PEN);
    painter->GetBrush()->SetColor(colour);
    painter->DrawEllipseWedge(x(mark.x), y(mark.y), outer, outer, inner, inner, 0, 360);
  }

  void paint(vtkContext2D* painter, const Drawing::Label& label) const {
    vtkTextProperty* text = painter->GetTextProp();
    text->SetColor(0.13, 0.13, 0.16);
    text->SetFontFamilyToArial();
    text->SetFontSize(static_cast<int>(0.95 * x(label.size)));
    text->SetJustification(static_cast<int>(label.anchor));  // VTK counts in the same order
    text->SetVerticalJustificationToBottom();
    text->SetOrientation(label.isUpwards ? 90 : 0);
    const double descent = 0.22 * label.size;
    painter->DrawString(x(label.x + (label.isUpwards ? descent : 0)),
                        y(label.y + (label.isUpwards ? 0 : descent)), label.text.c_str());
  }
};
vtkStandardNewMacro(DrawingItem);

void draw(const Drawing& drawing, const std::string& path) {
  const VirtualDisplay display;
  vtkNew<DrawingItem> item;
  item->drawing = drawing;
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(item);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(actor);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(static_cast<int>(kScale * drawing.width),
                  static_cast<int>(kScale * drawing.height));
  window->AddRenderer(renderer);
  window->Render();
  writePng(window, path);
}

}  // namespace
}  // namespace palpate::app

extern "C" __attribute__((visibility("default"))) std::string palpate_draw_drawing(
    const palpate::app::Drawing& drawing, const std::string& path) {
  try {
    palpate::app::draw(drawing, path);
    return {};
  } catch (const std::exception& failure) {
    return failure.what();
  }
}
