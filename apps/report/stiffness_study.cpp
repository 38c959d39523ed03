// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "report/stiffness_study.h"

#include <conversion.h>
#include <read_files.h>
#include <vtkBoundaryElementGreensFunctions.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIsotropicRemeshing.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkReferenceBoundaryConditions.h>
#include <vtkStiffnessArtifacts.h>
#include <vtkSurfaceRefinement.h>

#include <algorithm>
#include <cmath>
#include <Eigen/LU>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "mesh/surface_mesh.h"

namespace palpate::app {
namespace {

using Surface = vtkSmartPointer<vtkPolyData>;

SurfaceMesh meshOf(vtkPolyData* surface) {
  return SurfaceMesh(convert::pointsOf(surface), convert::trianglesOf(surface));
}

bool isModel(vtkPolyData* surface) {
  return convert::hasField(surface, "GreensFunctions");
}

Surface refined(vtkPolyData* surface, int level) {
  vtkNew<vtkSurfaceRefinement> filter;
  filter->SetInputData(surface);
  filter->SetNumberOfLevels(level - 1);
  return run(filter);
}

Surface remeshed(vtkPolyData* surface, double edgeLength) {
  vtkNew<vtkIsotropicRemeshing> filter;
  filter->SetInputData(surface);
  filter->SetEdgeLength(edgeLength);
  return run(filter);
}

/// @param columns  all free vertices' if empty.
Surface precomputed(vtkPolyData* surface, const std::string& precision,
                    const std::vector<int>& columns = {}) {
  vtkNew<vtkReferenceBoundaryConditions> conditions;
  conditions->SetInputData(surface);
  vtkNew<vtkBoundaryElementGreensFunctions> bem;
  bem->SetInputData(run(conditions));
  bem->SetPrecision(precision == "mixed" ? 1 : precision == "float" ? 2 : 0);
  vtkNew<vtkIdTypeArray> nodes;
  for (int node : columns) nodes->InsertNextValue(node);
  if (!columns.empty()) bem->SetColumnNodes(nodes);
  return run(bem);
}

/// The free vertex that is farthest from the support: an end of the object that shows its levels.
std::array<double, 3> farthestPoint(vtkPolyData* surface) {
  const Eigen::Matrix3Xd points = convert::pointsOf(surface);
  const std::vector<unsigned char> types = convert::boundaryTypesOf(surface, false);
  double farthest = -1;
  Eigen::Vector3d found = points.col(0);
  for (Eigen::Index v = 0; v < points.cols(); ++v) {
    if (types[v] != 0) continue;
    double away = std::numeric_limits<double>::infinity();
    for (Eigen::Index w = 0; w < points.cols(); ++w)
      if (types[w] != 0) away = std::min(away, (points.col(v) - points.col(w)).norm());
    if (away > farthest) {
      farthest = away;
      found = points.col(v);
    }
  }
  return {found.x(), found.y(), found.z()};
}

int nearestFreeVertex(vtkPolyData* surface, const std::array<double, 3>& place) {
  const Eigen::Matrix3Xd points = convert::pointsOf(surface);
  const std::vector<unsigned char> types = convert::boundaryTypesOf(surface, false);
  const Eigen::Vector3d at(place.data());
  int nearest = -1;
  for (int v = 0; v < points.cols(); ++v)
    if (types[v] == 0 &&
        (nearest < 0 || (points.col(v) - at).norm() < (points.col(nearest) - at).norm()))
      nearest = v;
  if (nearest < 0) throw std::invalid_argument("there is no free vertex to look at");
  return nearest;
}

struct Named {
  std::string name;
  int level;
  Surface surface;
};

/// The meshes that are studied whole, with their Green's functions, the coarsest first.
std::vector<Named> modelsOf(const StudyOptions& options) {
  std::vector<Named> models;
  for (const std::string& path : options.inputs) {
    const Surface surface = readSurface(path);
    const std::string name = std::filesystem::path(path).stem().string();
    if (isModel(surface)) {
      models.push_back({name, 0, surface});
      continue;
    }
    std::vector<int> levels = options.levels;
    if (levels.empty()) levels = {1};
    for (int level : levels)
      models.push_back({name + ", level " + std::to_string(level), level, refined(surface, level)});
    const Surface finest = refined(surface, *std::max_element(levels.begin(), levels.end()));
    for (double edge : options.edgeLengths)
      models.push_back({name + ", remeshed at " + number(edge), 0, remeshed(finest, edge)});
  }
  for (Named& model : models)
    if (!isModel(model.surface)) model.surface = precomputed(model.surface, options.precision);
  std::stable_sort(models.begin(), models.end(), [](const Named& a, const Named& b) {
    return meshOf(a.surface).meanEdgeLength() > meshOf(b.surface).meanEdgeLength();
  });
  return models;
}

MaskOptions maskOf(const StiffnessStudy& study, const StudyOptions& options, bool isMasked) {
  MaskOptions mask = options.mask;
  mask.radiusEdges = 0;
  mask.radius = isMasked ? study.radius : 0;
  if (!isMasked) mask.mask = "linear";
  return mask;
}

Surface artifactsOf(vtkPolyData* model, const StiffnessStudy& study, const StudyOptions& options,
                    bool isMasked, vtkPolyData* finer) {
  vtkNew<vtkStiffnessArtifacts> filter;
  filter->SetInputData(model);
  const MaskOptions mask = maskOf(study, options, isMasked);
  mask.applyTo(filter);
  filter->SetMeasure(mask.measureNumber());
  filter->SetRigidStiffness(mask.rigidStiffness);
  filter->SetSmoothingLength(study.smoothingLength);
  if (finer) filter->SetReferenceData(finer);
  const Surface result = run(filter);
  vtkNew<vtkPolyData> kept;  // the output of a filter is the filter's
  kept->ShallowCopy(result);
  return kept.GetPointer();
}

Eigen::Matrix3d stiffnessAt(vtkPolyData* model, const StiffnessStudy& study,
                            const StudyOptions& options, bool isMasked, int vertex) {
  vtkNew<vtkSurfaceStiffness> filter;
  filter->SetInputData(model);
  const MaskOptions mask = maskOf(study, options, isMasked);
  mask.applyTo(filter);
  filter->SetMeasure(mask.measureNumber());
  const Surface result = run(filter);
  return convert::pointMatricesOf(result, "Stiffness", "")[vertex];
}

PointSample sampleOf(const Named& mesh, vtkPolyData* model, const StiffnessStudy& study,
                     const StudyOptions& options) {
  const SurfaceMesh surface = meshOf(model);
  const int vertex = nearestFreeVertex(model, study.point);
  const Eigen::Vector3d at(study.point.data());
  PointSample sample;
  sample.name = mesh.name;
  sample.level = mesh.level;
  sample.vertices = surface.vertexCount();
  sample.edge = surface.meanEdgeLength();
  sample.size = std::sqrt(surface.vertexAreas()[vertex]);
  sample.apart = (surface.points().col(vertex) - at).norm();
  const Eigen::Matrix3d single = stiffnessAt(model, study, options, false, vertex);
  sample.single = single.norm();
  sample.compliance = single.inverse().norm();
  const Eigen::Matrix3d masked = stiffnessAt(model, study, options, true, vertex);
  sample.masked = masked.norm();
  sample.maskedCompliance = masked.inverse().norm();
  return sample;
}

/// Levels of the table alone: the columns of the mask around the point, and of no more.
void addTableLevels(StiffnessStudy& study, const StudyOptions& options) {
  if (options.tableLevels.empty()) return;
  const Surface control = readSurface(options.inputs.front());
  const std::string name = std::filesystem::path(options.inputs.front()).stem().string();
  for (int level : options.tableLevels) {
    const Surface surface = refined(control, level);
    const Eigen::Matrix3Xd points = convert::pointsOf(surface);
    const std::vector<unsigned char> types = convert::boundaryTypesOf(surface, false);
    const Eigen::Vector3d centre = points.col(nearestFreeVertex(surface, study.point));
    std::vector<int> columns;
    for (int v = 0; v < points.cols(); ++v)
      if (types[v] == 0 && (points.col(v) - centre).norm() <= study.radius) columns.push_back(v);
    const Named named{name + ", level " + std::to_string(level), level, surface};
    study.points.push_back(
        sampleOf(named, precomputed(surface, options.precision, columns), study, options));
  }
}

void fitLaw(StiffnessStudy& study) {
  std::vector<double> sizes, compliances;
  const bool hasHierarchy = std::count_if(study.points.begin(), study.points.end(),
                                          [](const PointSample& p) { return p.level > 0; }) > 2;
  for (const PointSample& sample : study.points)
    if (sample.level > 0 || !hasHierarchy) {
      sizes.push_back(sample.size);
      compliances.push_back(sample.compliance);
    }
  study.hasLaw = sizes.size() > 2;
  if (study.hasLaw)
    study.law = fitPointSingularity(Eigen::Map<Eigen::VectorXd>(sizes.data(), sizes.size()),
                                    Eigen::Map<Eigen::VectorXd>(compliances.data(), sizes.size()));
}

void requireSensible(const StudyOptions& options) {
  const bool makesMeshes =
      !options.levels.empty() || !options.tableLevels.empty() || !options.edgeLengths.empty();
  if (!makesMeshes) return;
  if (options.inputs.size() != 1)
    throw std::invalid_argument("levels and edge lengths are of one surface: name one input");
  if (isModel(readSurface(options.inputs.front())))
    throw std::invalid_argument(options.inputs.front() +
                                " is a model: levels and edge lengths take a surface with its "
                                "support and material, which they are computed for");
}

}  // namespace

double fieldComponent(vtkPolyData* surface, const char* name, int component) {
  vtkDataArray* array = surface->GetFieldData()->GetArray(name);
  return array && component < array->GetNumberOfComponents()
             ? array->GetComponent(0, component)
             : std::numeric_limits<double>::quiet_NaN();
}

StiffnessStudy studyStiffness(const StudyOptions& options) {
  requireSensible(options);
  const std::vector<Named> models = modelsOf(options);
  StiffnessStudy study;
  const SurfaceMesh coarsest = meshOf(models.front().surface);
  const MaskOptions& mask = options.mask;
  study.radius = mask.radius > 0
                     ? mask.radius
                     : coarsest.meanEdgeLength() * (mask.radiusEdges > 0 ? mask.radiusEdges
                                                    : models.size() > 1  ? 1
                                                                         : 2);
  study.smoothingLength =
      options.smoothingLength > 0 ? options.smoothingLength : 0.1 * coarsest.diagonal();
  if (options.point.empty())
    study.point = farthestPoint(models.front().surface);
  else
    std::copy_n(options.point.begin(), 3, study.point.begin());

  vtkPolyData *finerBare = nullptr, *finerMasked = nullptr;
  for (auto model = models.rbegin(); model != models.rend(); ++model) {
    MeshStudy mesh;
    mesh.name = model->name;
    mesh.level = model->level;
    mesh.edge = meshOf(model->surface).meanEdgeLength();
    for (unsigned char type : convert::boundaryTypesOf(model->surface, false))
      mesh.free += type == 0;
    mesh.bare = artifactsOf(model->surface, study, options, false, finerBare);
    mesh.masked = artifactsOf(model->surface, study, options, true, finerMasked);
    finerBare = mesh.bare;
    finerMasked = mesh.masked;
    study.points.insert(study.points.begin(), sampleOf(*model, model->surface, study, options));
    study.meshes.insert(study.meshes.begin(), mesh);
  }
  addTableLevels(study, options);
  std::stable_sort(study.points.begin(), study.points.end(),
                   [](const PointSample& a, const PointSample& b) { return a.edge > b.edge; });
  fitLaw(study);
  return study;
}

}  // namespace palpate::app
