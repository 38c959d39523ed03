// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include <conversion.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointContact.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "mesh/surface_mesh.h"
#include "picture/picture.h"
#include "report/html.h"
#include "report/page_parts.h"
#include "report/plot.h"
#include "report/stiffness_study.h"

namespace palpate::app {
namespace {

using Range = std::array<double, 2>;

/// The middle of all values of a point array of several surfaces, from `low` to `high` of them.
Range rangeOf(const std::vector<std::pair<vtkPolyData*, const char*>>& fields, double low,
              double high) {
  std::vector<double> values;
  for (const auto& [surface, name] : fields) {
    vtkDataArray* array = surface->GetPointData()->GetArray(name);
    const std::vector<unsigned char> types = convert::boundaryTypesOf(surface, false);
    for (vtkIdType v = 0; v < array->GetNumberOfTuples(); ++v)
      if (types[v] == 0 && !std::isnan(array->GetComponent(v, 0)))
        values.push_back(array->GetComponent(v, 0));
  }
  std::sort(values.begin(), values.end());
  const auto at = [&](double share) { return values[std::lround(share * (values.size() - 1))]; };
  return {at(low), at(high)};
}

/// What colours a view, shared by all that are compared.
struct Scale {
  std::string barTitle;
  Range range;
  bool logarithmic = false;
};

View viewOf(vtkPolyData* surface, const std::string& title, const char* array, const Scale& scale) {
  return {surface, title, array, scale.barTitle, false, scale.range, scale.logarithmic};
}

/// Fig. 7: areas, single-vertex and masked stiffness of every mesh.
std::string fieldPictures(const StiffnessStudy& study) {
  std::vector<std::pair<vtkPolyData*, const char*>> areas, norms, artifacts;
  for (const MeshStudy& mesh : study.meshes) {
    areas.emplace_back(mesh.bare, "VertexArea");
    for (const auto& field : {mesh.bare, mesh.masked}) {
      norms.emplace_back(field, "StiffnessNorm");
      artifacts.emplace_back(field, "StiffnessArtifact");
    }
  }
  Scale area{"area\n(m^2)", rangeOf(areas, 0, 1), true};
  Scale norm{"|K|\n(N/m)", rangeOf(norms, 0.02, 0.98)};
  norm.logarithmic = norm.range[1] > 3 * norm.range[0];
  const Range spread = rangeOf(artifacts, 0.02, 0.98);
  const double most = std::max(-spread[0], spread[1]);
  const Scale artifact{"artefact", {-most, most}};
  const auto direction = directionOntoFreeSurface(study.meshes.back().bare);
  const auto sideBySide = [&](const std::vector<View>& views) {
    return Picture{views, direction, views.size() == 1 ? 430 : 770, 330, true};
  };
  std::string result;
  for (const MeshStudy& mesh : study.meshes) {
    const Picture left = sideBySide({viewOf(mesh.bare, "(a) vertex area", "VertexArea", area)});
    const Picture middle =
        sideBySide({viewOf(mesh.bare, "(b) |K|, single vertex", "StiffnessNorm", norm),
                    viewOf(mesh.masked, "(c) |K|, masked", "StiffnessNorm", norm)});
    const Picture below =
        sideBySide({viewOf(mesh.bare, "(d) artefact, single vertex", "StiffnessArtifact", artifact),
                    viewOf(mesh.masked, "(e) artefact, masked", "StiffnessArtifact", artifact)});
    result += "<figure><div class=\"row\"><div>" + drawn(left, mesh.name + ": vertex areas") +
              "</div><div>" +
              drawn(middle, mesh.name + ": stiffness of single vertices and under masks") +
              "</div></div>" +
              drawn(below, mesh.name + ": artefacts of single vertices and under masks") +
              "<figcaption><b>" + html::escaped(mesh.name) + "</b>, " +
              std::to_string(mesh.bare->GetNumberOfPoints()) +
              " vertices. Correlation of |K| with the area " +
              cell(fieldComponent(mesh.bare, "ArtifactAreaCorrelation", 1)) + " in (b), " +
              cell(fieldComponent(mesh.masked, "ArtifactAreaCorrelation", 1)) +
              " in (c); variation about the smooth part " +
              percent(fieldComponent(mesh.bare, "ArtifactVariation", 1)) + " in (d), " +
              percent(fieldComponent(mesh.masked, "ArtifactVariation", 1)) +
              " in (e).</figcaption></figure>\n";
  }
  return result;
}

/// A surface under a force along its normal at the study's point.
vtkSmartPointer<vtkPolyData> pulled(vtkPolyData* model, const StiffnessStudy& study,
                                    const StudyOptions& options, double radius,
                                    const Eigen::Vector3d& force) {
  vtkNew<vtkPointContact> contact;
  MaskOptions mask = options.mask;
  mask.radiusEdges = 0;
  mask.radius = radius;
  if (radius == 0) mask.mask = "linear";
  contact->SetInputData(model);
  mask.applyTo(contact);
  contact->SetPoint(study.point.data());
  contact->SetForce(force.data());
  vtkNew<vtkPolyData> kept;
  kept->ShallowCopy(run(contact));
  return kept.GetPointer();
}

/// How pulls are drawn: along the normal, large enough to see, looked at from the side.
struct Pull {
  Eigen::Vector3d force;
  std::array<double, 3> direction;
};

Pull pullOf(const StiffnessStudy& study) {
  vtkPolyData* finest = study.meshes.back().bare;
  const SurfaceMesh mesh(convert::pointsOf(finest), convert::trianglesOf(finest));
  const Eigen::Vector3d at(study.point.data());
  Eigen::Index vertex;
  (mesh.points().colwise() - at).colwise().norm().minCoeff(&vertex);
  const Eigen::Vector3d normal = mesh.vertexNormals().col(vertex);
  double softest = 1e300;
  for (const MeshStudy& each : study.meshes)
    for (const PointSample& sample : study.points)
      if (sample.name == each.name) softest = std::min(softest, 1 / sample.compliance);
  const auto onto = directionOntoFreeSurface(finest);
  Eigen::Vector3d towards(onto.data());
  towards -= 0.85 * towards.dot(normal) * normal;
  return {0.25 * mesh.diagonal() * softest * normal, {towards.x(), towards.y(), towards.z()}};
}

/// Views of pulls side by side.
struct Pulls {
  std::vector<vtkSmartPointer<vtkPolyData>> surfaces;
  std::vector<std::string> titles;
  std::string description;
};

double largestDisplacement(const Pulls& pulls) {
  double most = 0;
  for (const auto& surface : pulls.surfaces)
    most = std::max(most, surface->GetPointData()->GetArray("Displacement")->GetMaxNorm());
  return most;
}

/// @param most  of the colours, m.
std::string pullPicture(const Pulls& pulls, const Pull& pull, double most) {
  Picture picture;
  for (std::size_t i = 0; i < pulls.surfaces.size(); ++i)
    picture.views.push_back({pulls.surfaces[i], pulls.titles[i], "Displacement", "moved by\n(m)",
                             true, Range{0, most}});
  picture.towardsViewer = pull.direction;
  picture.width = 150 + 300 * static_cast<int>(pulls.surfaces.size());
  picture.height = 360;
  picture.sharesBar = true;
  return figure(drawn(picture, pulls.description), html::escaped(pulls.description));
}

/// Fig. 4: one force on every mesh, at a vertex and under the mask.
std::string pullsOfMeshes(const StiffnessStudy& study, const StudyOptions& options,
                          const Pull& pull) {
  Pulls both[2];
  for (bool isMasked : {false, true}) {
    Pulls& pulls = both[isMasked];
    pulls.description = "A force of " + number(pull.force.norm(), 3) + " N on " +
                        (isMasked ? "a mask of " + number(study.radius, 3) + " m"
                                  : std::string("a single vertex")) +
                        ", the same for every mesh; deformations and colours to one scale.";
    for (const MeshStudy& mesh : study.meshes) {
      const double radius = isMasked ? study.radius : 0;
      pulls.surfaces.push_back(pulled(mesh.bare, study, options, radius, pull.force));
      pulls.titles.push_back(std::to_string(mesh.bare->GetNumberOfPoints()) + " vertices");
    }
  }
  const double most = std::max(largestDisplacement(both[0]), largestDisplacement(both[1]));
  return pullPicture(both[0], pull, most) + pullPicture(both[1], pull, most);
}

/// Fig. 6: one force under masks of three radii.
std::string pullsOfMasks(const StiffnessStudy& study, const StudyOptions& options,
                         const Pull& pull) {
  const MeshStudy& finest = study.meshes.back();
  Pulls pulls;
  pulls.description = "The same force of " + number(2 * pull.force.norm(), 3) +
                      " N under masks of three radii, on the finest mesh (" + finest.name + ").";
  for (double share : {0.5, 1., 2.}) {
    pulls.surfaces.push_back(
        pulled(finest.bare, study, options, share * study.radius, 2 * pull.force));
    pulls.titles.push_back("r = " + number(share * study.radius, 3) + " m");
  }
  return pullPicture(pulls, pull, largestDisplacement(pulls));
}

std::string measureTable(const StiffnessStudy& study) {
  std::vector<std::vector<std::string>> rows;
  for (const MeshStudy& mesh : study.meshes) {
    std::vector<std::string> row{html::escaped(mesh.name),
                                 std::to_string(mesh.bare->GetNumberOfPoints()),
                                 std::to_string(mesh.free), cell(mesh.edge)};
    for (const char* measure :
         {"ArtifactAreaCorrelation", "ArtifactVariation", "ArtifactLargestJump"})
      for (const auto& field : {mesh.bare, mesh.masked}) {
        const double value = fieldComponent(field, measure, 1);
        row.push_back(measure == std::string("ArtifactAreaCorrelation") ? cell(value)
                                                                        : percent(value));
      }
    for (int component : {0, 2})
      for (const auto& field : {mesh.bare, mesh.masked})
        row.push_back(percent(fieldComponent(field, "StiffnessChangeMeasures", component)));
    rows.push_back(row);
  }
  return html::table(
      {"mesh", "vertices", "free", "mean edge, m", "correlation with area, single", "masked",
       "variation, single", "masked", "largest jump, single", "masked",
       "median against next finer, single", "masked", "95 % within, single", "masked"},
      rows);
}

std::string pointTable(const StiffnessStudy& study) {
  std::vector<std::vector<std::string>> rows;
  for (const PointSample& point : study.points)
    rows.push_back({html::escaped(point.name), std::to_string(point.vertices), cell(point.edge),
                    cell(point.size), cell(point.single), cell(point.masked),
                    cell(point.compliance), cell(point.apart)});
  return html::table({"mesh", "vertices", "mean edge, m", "h = √a, m", "‖K‖ single, N/m",
                      "‖K‖ masked, N/m", "single compliance, m/N", "vertex is off by, m"},
                     rows);
}

std::string lawText(const StiffnessStudy& study) {
  if (!study.hasLaw) return {};
  const PointSingularity& law = study.law;
  Series single{"single vertex", "#440154", {}, {}}, masked{"masked", "#21918c", {}, {}},
      fit{"b + c/h", "#440154", {}, {}, Series::Style::Line};
  double low = 1e300, high = 0;
  for (const PointSample& point : study.points) {
    single.x.push_back(point.size);
    single.y.push_back(point.compliance);
    masked.x.push_back(point.size);
    masked.y.push_back(point.maskedCompliance);
    low = std::min(low, point.size);
    high = std::max(high, point.size);
  }
  for (int i = 0; i <= 40; ++i) {
    const double h = low * std::pow(high / low, i / 40.), y = law.body + law.coefficient / h;
    if (!(y > 0)) continue;
    fit.x.push_back(h);
    fit.y.push_back(y);
  }
  std::vector<Series> all{single, masked};
  if (fit.x.size() > 1) all.push_back(fit);
  return "<p>The compliance of a single vertex grows like h<sup>−" + number(law.exponent, 3) +
         "</sup> (R² " + number(law.exponentFit, 4) +
         "); as b + c/h, what the body yields beside "
         "the point's own, b = " +
         number(law.body, 3) + " m/N, c = " + number(law.coefficient, 3) + " m²/N (R² " +
         number(law.fit, 4) + "). An ideal point load has the exponent 1.</p>\n<figure>" +
         inlineSvg({"", "h, root of the vertex's area (m)", "compliance (m/N)", all}) +
         "<figcaption>Compliance at the point over the size of the vertex that is "
         "loaded.</figcaption>"
         "</figure>\n";
}

std::string leadText(const StiffnessStudy& study) {
  const MeshStudy& mesh = study.meshes.back();
  const auto value = [&](vtkPolyData* field, const char* name) {
    return fieldComponent(field, name, 1);
  };
  const double masked = value(mesh.masked, "ArtifactAreaCorrelation");
  std::string text = "<p class=\"lead\">On the finest mesh, " + html::escaped(mesh.name) + ", " +
                     std::to_string(mesh.bare->GetNumberOfPoints()) +
                     " vertices, the stiffness of single vertices follows the vertex areas with a "
                     "rank correlation "
                     "of <b>" +
                     cell(value(mesh.bare, "ArtifactAreaCorrelation")) + "</b>; under masks of " +
                     number(study.radius, 3) + " m it is <b>" + cell(masked) +
                     "</b>. Its variation about the smooth part is <b>" +
                     percent(value(mesh.bare, "ArtifactVariation")) + "</b> without and <b>" +
                     percent(value(mesh.masked, "ArtifactVariation")) + "</b> with masks.</p>\n";
  if (value(mesh.masked, "ArtifactVariation") > value(mesh.bare, "ArtifactVariation"))
    text +=
        "<p>Masks do not lower the variation here: they are wide, and vertices close to the "
        "support, "
        "which finer meshes have more of, are truly stiffer under them. The change against other "
        "meshes at the same points tells the mesh's share.</p>\n";
  if (std::abs(masked) > 0.3)
    text +=
        "<p>The masked field still goes with the areas, though masks make it independent of single "
        "vertices: on this object areas go with the shape (fine at the support or where it curves, "
        "say). The change against other meshes at the same points tells the mesh's share.</p>\n";
  return text;
}

constexpr const char* kMethod =
    "<h2>How it is measured</h2>\n<ul>\n"
    "<li><b>Stiffness</b> K: force per displacement of a vertex, by the Green's functions; ‖K‖ is "
    "its Frobenius norm. <i>Single</i>: the force goes to one vertex. <i>Masked</i>: it is spread "
    "by a "
    "pressure mask of one radius for all meshes (James &amp; Pai 2001, eq. 32).</li>\n"
    "<li><b>Smooth part</b>: s that makes ∫ (ln‖K‖ − ln s)² + ℓ⁴ (Δ ln s)² over the free "
    "surface least (their appendix A, biharmonic). ℓ is a length, not a number of edges, so that "
    "all meshes lose the same; waves of 2πℓ pass by half, twice as long ones by 94 %. "
    "<b>Artefact</b>: ‖K‖/s − 1. <b>Variation</b>: standard deviation of ‖K‖/s over its mean, by "
    "area. It keeps what the body itself varies within ℓ, above all beside the support.</li>\n"
    "<li><b>Correlation with area</b>: Spearman's rank correlation of ‖K‖ with the vertex areas. "
    "<b>Largest jump</b>: |‖K<sub>i</sub>‖ − ‖K<sub>j</sub>‖| over their mean, of all edges.</li>\n"
    "<li><b>Against the next finer</b> mesh: ‖K‖ over that of the finer mesh's nearest point, "
    "minus 1 "
    "(normals within 60°, no further than an edge); median and 95th percentile of its size, "
    "by area.</li>\n</ul>\n";

}  // namespace

std::string studyPage(const StiffnessStudy& study, const StudyOptions& options) {
  std::string title = "Stiffness artefacts:";
  for (const std::string& path : options.inputs)
    title +=
        (path == options.inputs.front() ? " " : ", ") + std::filesystem::path(path).stem().string();
  std::string body = "<h1>" + html::escaped(title) + "</h1>\n<p>" +
                     std::to_string(study.meshes.size()) +
                     (study.meshes.size() > 1 ? " meshes of one object, " : " mesh, ") +
                     options.mask.mask + " masks of " + number(study.radius, 3) +
                     " m, smoothing length ℓ = " + number(study.smoothingLength, 3) +
                     " m, point (" + number(study.point[0], 3) + ", " + number(study.point[1], 3) +
                     ", " + number(study.point[2], 3) + ") m. Palpate " PALPATE_VERSION ".</p>\n";
  const Pull pull = pullOf(study);
  body += leadText(study) + "<h2>Meshes</h2>\n" + measureTable(study) + "<h2>The surface</h2>\n" +
          fieldPictures(study) + "<h2>A point load</h2>\n" + pointTable(study) + lawText(study) +
          pullsOfMeshes(study, options, pull) + "<h2>The size of the mask</h2>\n" +
          pullsOfMasks(study, options, pull) + kMethod;
  return html::page(title, body);
}

}  // namespace palpate::app
