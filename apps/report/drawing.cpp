// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/drawing.h"

#include <sstream>
#include <stdexcept>

#include "library.h"
#include "report/html.h"

namespace palpate::app {
namespace {

constexpr const char* kInk = "#22222a";
const char* const kAnchors[] = {"start", "middle", "end"};

void write(std::ostream& out, const Drawing::Line& line) {
  out << "<polyline fill=\"none\" stroke=\"" << line.colour << "\" stroke-width=\"" << line.width
      << "\"" << (line.isDashed ? " stroke-dasharray=\"6 4\"" : "") << " points=\"";
  for (std::size_t i = 0; i < line.points.size(); ++i)
    out << (i ? " " : "") << line.points[i][0] << "," << line.points[i][1];
  out << "\"/>\n";
}

void write(std::ostream& out, const Drawing::Mark& mark) {
  out << "<circle cx=\"" << mark.x << "\" cy=\"" << mark.y << "\" r=\"" << mark.radius << "\"";
  if (mark.isHollow)
    out << " fill=\"none\" stroke-width=\"1.5\" stroke=\"" << mark.colour << "\"/>\n";
  else
    out << " fill=\"" << mark.colour << "\"/>\n";
}

void write(std::ostream& out, const Drawing::Label& label) {
  out << "<text font-size=\"" << label.size << "\" text-anchor=\""
      << kAnchors[static_cast<int>(label.anchor)] << "\" ";
  if (label.isUpwards)
    out << "transform=\"translate(" << label.x << " " << label.y << ") rotate(-90)\"";
  else
    out << "x=\"" << label.x << "\" y=\"" << label.y << "\"";
  out << ">" << html::escaped(label.text) << "</text>\n";
}

}  // namespace

std::string svgOf(const Drawing& drawing, const std::string& description, bool isFile) {
  std::ostringstream out;
  if (isFile) out << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  out << "<svg "
      << (isFile ? "xmlns=\"http://www.w3.org/2000/svg\" "
                 : "style=\"max-width: 100%; height: auto\" ")
      << "viewBox=\"0 0 " << drawing.width << " " << drawing.height << "\" width=\""
      << drawing.width << "\" role=\"img\" aria-label=\"" << html::escaped(description)
      << "\" font-family=\"system-ui, sans-serif\" fill=\"" << kInk << "\">\n";
  if (isFile)
    out << "<rect width=\"" << drawing.width << "\" height=\"" << drawing.height
        << "\" fill=\"#ffffff\"/>\n";
  for (const Drawing::Line& line : drawing.lines) write(out, line);
  for (const Drawing::Mark& mark : drawing.marks) write(out, mark);
  for (const Drawing::Label& label : drawing.labels) write(out, label);
  out << "</svg>\n";
  return out.str();
}

void drawDrawing(const Drawing& drawing, const std::string& path) {
  static const auto draw = reinterpret_cast<DrawDrawingFunction>(
      loadFunction("libpalpate_picture.so", kDrawDrawingFunction, "pictures cannot be drawn"));
  const std::string failure = draw(drawing, path);
  if (!failure.empty()) throw std::runtime_error(failure);
}

}  // namespace palpate::app
