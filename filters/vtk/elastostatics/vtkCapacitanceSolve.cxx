// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "vtkCapacitanceSolve.h"

#include "array_names.h"
#include "contact/capacitance_solver.h"
#include "conversion.h"
#include "greens/surface_fields.h"
#include "model_arrays.h"

#include "vtkCellData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

vtkStandardNewMacro(vtkCapacitanceSolve);

namespace arrays = palpate::arrays;
namespace convert = palpate::convert;

/// A solver with its cache of inverses, and the input that it belongs to.
struct vtkCapacitanceSolve::Prepared
{
  vtkPolyData* Input;
  vtkMTimeType InputTime;
  convert::ServedModel Served;
  Eigen::Matrix3Xd ForcePoints;
  palpate::CapacitanceSolver Solver;
};

vtkCapacitanceSolve::vtkCapacitanceSolve()
{
  this->SetNumberOfInputPorts(2);
}

vtkCapacitanceSolve::~vtkCapacitanceSolve() = default;

void vtkCapacitanceSolve::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "TriangleTractionArrayName: " << this->TriangleTractionArrayName << "\n";
}

int vtkCapacitanceSolve::FillInputPortInformation(int port, vtkInformation* info)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, info);
  }
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

void vtkCapacitanceSolve::SetTriangleTractionArrayName(const char* name)
{
  this->SetName(this->TriangleTractionArrayName, name);
}

vtkCapacitanceSolve::Prepared& vtkCapacitanceSolve::Prepare(vtkPolyData* input)
{
  if (!this->Kept || this->Kept->Input != input || this->Kept->InputTime != input->GetMTime())
  {
    this->Kept.reset();
    convert::ServedModel served = convert::servedModelOf(input);
    Eigen::Matrix3Xd points = palpate::forcePoints(
      *served.mesh, served.greens->info().conditions, served.smoothPatches);
    palpate::CapacitanceSolver solver(served.greens, served.mesh);
    this->Kept.reset(new Prepared{
      input, input->GetMTime(), std::move(served), std::move(points), std::move(solver) });
  }
  return *this->Kept;
}

namespace
{
/// The constraint table, column by column, with defaults for what is optional.
class ConstraintTable
{
public:
  explicit ConstraintTable(vtkDataObject* data)
  {
    vtkDataSetAttributes* attributes = nullptr;
    if (auto* points = vtkPointSet::SafeDownCast(data))
    {
      attributes = points->GetPointData();
    }
    else if (auto* table = vtkTable::SafeDownCast(data))
    {
      attributes = table->GetRowData();
    }
    if (!attributes || data->GetNumberOfElements(vtkDataObject::POINT) +
          data->GetNumberOfElements(vtkDataObject::ROW) == 0)
    {
      return;
    }
    this->Node = this->Find(attributes, arrays::Node, 1);
    if (!this->Node)
    {
      throw std::invalid_argument(
        std::string("the constraints have no array '") + arrays::Node + "' of vertex numbers");
    }
    this->Count = this->Node->GetNumberOfTuples();
    this->Displacement = this->Find(attributes, arrays::Displacement, 3);
    this->Traction = this->Find(attributes, arrays::Traction, 3);
    this->Type = this->Find(attributes, arrays::BoundaryType, 1);
    this->Direction = this->Find(attributes, arrays::Direction, 3);
    this->ZoneNumber = this->Find(attributes, arrays::Zone, 1);
    this->Spring = this->Find(attributes, arrays::SpringStiffness, 1);
    this->RequireBoundaryTypes();
  }

  vtkIdType GetCount() const { return this->Count; }
  double GetNode(vtkIdType i) const { return this->Node->GetComponent(i, 0); }
  bool IsDisplacement(vtkIdType i) const { return !this->Type || this->Type->GetComponent(i, 0) != 0; }
  int GetZone(vtkIdType i) const
  {
    return this->ZoneNumber
      ? convert::wholeNumber(this->ZoneNumber->GetComponent(i, 0), "the zone of constraint ", i)
      : 0;
  }
  Eigen::Vector3d GetValue(vtkIdType i) const
  {
    return VectorOf(this->IsDisplacement(i) ? this->Displacement : this->Traction, i);
  }
  /// N/m, 0 for none.
  double GetSpring(vtkIdType i) const
  {
    const double stiffness = this->Spring ? this->Spring->GetComponent(i, 0) : 0;
    if (!(stiffness >= 0 && std::isfinite(stiffness)) || (stiffness > 0 && !this->IsDisplacement(i)))
    {
      throw std::invalid_argument("the spring of constraint " + std::to_string(i) +
        (stiffness > 0 && std::isfinite(stiffness)
            ? " goes with a displacement, not with a traction"
            : " must have a stiffness from 0 on, not " + std::to_string(stiffness)));
    }
    return stiffness;
  }
  Eigen::Vector3d GetDirection(vtkIdType i) const { return VectorOf(this->Direction, i); }

private:
  vtkDataArray* Find(vtkDataSetAttributes* attributes, const char* name, int components) const
  {
    vtkDataArray* array = attributes->GetArray(name);
    if (array && array->GetNumberOfComponents() != components)
    {
      throw std::invalid_argument(std::string("the constraints' array '") + name + "' must have " +
        std::to_string(components) + " components, not " +
        std::to_string(array->GetNumberOfComponents()));
    }
    if (array && this->Node && array->GetNumberOfTuples() != this->Count)
    {
      throw std::invalid_argument(std::string("the constraints' array '") + name + "' must have " +
        std::to_string(this->Count) + " tuples, one a constraint, not " +
        std::to_string(array->GetNumberOfTuples()));
    }
    return array;
  }
  void RequireBoundaryTypes() const
  {
    for (vtkIdType i = 0; this->Type && i < this->Count; ++i)
    {
      const double type = this->Type->GetComponent(i, 0);
      if (type != 0 && type != 1)
      {
        throw std::invalid_argument("the boundary type of constraint " + std::to_string(i) +
          " must be 0 (traction) or 1 (displacement), not " + std::to_string(type));
      }
    }
  }
  static Eigen::Vector3d VectorOf(vtkDataArray* array, vtkIdType i)
  {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    if (array)
    {
      array->GetTuple(i, value.data());
    }
    return value;
  }

  vtkIdType Count = 0;
  vtkDataArray *Node = nullptr, *Displacement = nullptr, *Traction = nullptr, *Type = nullptr,
               *Direction = nullptr, *ZoneNumber = nullptr, *Spring = nullptr;
};

/// The table as switches and given values. What agrees with the reference problem (a traction at a
/// free vertex, a movement of a fixed one) is a given value; the rest are switches.
struct Problem
{
  palpate::BoundaryValues Values;
  std::map<int, std::set<int>> Zones; // vertices with prescribed displacement; 0 if there is none

  Problem(const ConstraintTable& table, const palpate::GreensFunctions& greens)
  {
    const int count = greens.nodeCount();
    this->Values.given = Eigen::Matrix3Xd::Zero(3, count);
    std::vector<double> prescribed;
    for (vtkIdType i = 0; i < table.GetCount(); ++i)
    {
      const int node = convert::vertexNumber(table.GetNode(i), count, "constraint ", i);
      const Eigen::Vector3d direction = table.GetDirection(i);
      Eigen::Vector3d value = table.GetValue(i);
      const double spring = table.GetSpring(i), area = greens.vertexArea(node);
      double yield = 0;
      if (spring > 0)
      {
        yield = greens.isFixed(node) ? spring / area : area / spring;
        value *= greens.isFixed(node) ? yield : 1; // a traction there: that of the spring at rest
      }
      if (table.IsDisplacement(i))
      {
        this->Zones[table.GetZone(i)].insert(node);
      }
      if (spring == 0 && greens.isFixed(node) == table.IsDisplacement(i))
      {
        this->AddGiven(node, value, direction);
        continue;
      }
      if (direction.isZero(0))
      {
        for (int c = 0; c < 3; ++c)
        {
          this->Values.switches.push_back({ node, Eigen::Vector3d::Unit(c), yield });
          prescribed.push_back(value[c]);
        }
      }
      else
      {
        this->Values.switches.push_back({ node, direction.normalized(), yield });
        prescribed.push_back(value.dot(direction.normalized()));
      }
    }
    if (this->Zones.empty())
    {
      this->Zones[0];
    }
    this->Values.prescribed = Eigen::Map<Eigen::VectorXd>(prescribed.data(), prescribed.size());
  }

private:
  /// Components add up to the vector that they are given of if they are at right angles.
  void AddGiven(int node, const Eigen::Vector3d& value, const Eigen::Vector3d& direction)
  {
    const Eigen::Vector3d along = direction.normalized();
    std::vector<Eigen::Vector3d>& others = this->GivenAlong[node];
    for (const Eigen::Vector3d& other : others)
    {
      const double overlap = along.isZero(0) || other.isZero(0) ? 1 : std::abs(along.dot(other));
      if (overlap > 1e-9)
      {
        throw std::invalid_argument("node " + std::to_string(node) +
          (overlap > 1 - 1e-9
              ? " is constrained twice along the same direction"
              : " is constrained along directions that are not at right angles to each other"));
      }
    }
    others.push_back(along);
    this->Values.given.col(node) += along.isZero(0) ? value : along * along.dot(value);
  }

  std::map<int, std::vector<Eigen::Vector3d>> GivenAlong; // zero for the whole vector
};

Eigen::Matrix3Xd triangleTractionsOf(vtkPolyData* surface, const std::string& name)
{
  vtkDataArray* array = surface->GetCellData()->GetArray(name.c_str());
  if (!array || array->GetNumberOfComponents() != 3)
  {
    throw std::invalid_argument("there is no cell array '" + name + "' of three components");
  }
  Eigen::Matrix3Xd tractions(3, array->GetNumberOfTuples());
  for (vtkIdType f = 0; f < array->GetNumberOfTuples(); ++f)
  {
    array->GetTuple(f, tractions.col(f).data());
  }
  if (!tractions.allFinite())
  {
    throw std::invalid_argument("the cell array '" + name + "' holds values that are not finite");
  }
  return tractions;
}

/// Solves with loads on triangles by superposition: the reference problem under the loads, and the
/// constraints less what the loads do there.
palpate::BoundarySolution solveWithLoads(palpate::CapacitanceSolver& solver,
  palpate::BoundaryValues values, const convert::ServedModel& served, vtkPolyData* surface,
  const std::string& tractionName)
{
  if (tractionName.empty())
  {
    return solver.solve(values);
  }
  Eigen::Matrix3Xd applied;
  const Eigen::Matrix3Xd background = palpate::solveFaceTractions(*served.greens, *served.mesh,
    served.smoothPatches, triangleTractionsOf(surface, tractionName), applied);
  for (std::size_t k = 0; k < values.switches.size(); ++k)
  {
    values.prescribed[k] -=
      values.switches[k].direction.dot(background.col(values.switches[k].node));
  }
  palpate::BoundarySolution solution = solver.solve(values);
  for (int node = 0; node < served.greens->nodeCount(); ++node)
  {
    (served.greens->isFixed(node) ? solution.traction : solution.displacement).col(node) +=
      background.col(node);
    solution.traction.col(node) += applied.col(node) / served.greens->vertexArea(node);
  }
  return solution;
}
} // namespace

void vtkCapacitanceSolve::Compute(
  vtkPolyData* input, vtkPolyData* output, vtkInformationVector** inputs)
{
  Prepared& prepared = this->Prepare(input);
  const palpate::GreensFunctions& greens = *prepared.Served.greens;
  const palpate::SurfaceMesh& mesh = *prepared.Served.mesh;
  const Problem problem(ConstraintTable(vtkDataObject::GetData(inputs[1])), greens);
  const palpate::BoundarySolution solution = solveWithLoads(prepared.Solver, problem.Values,
    prepared.Served, input, this->TriangleTractionArrayName);

  Eigen::Matrix3Xd forces(3, problem.Zones.size()), torques(3, problem.Zones.size());
  int zone = 0;
  for (const auto& [number, members] : problem.Zones)
  {
    const std::vector<int> nodes(members.begin(), members.end());
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int node : nodes)
    {
      centre += mesh.points().col(node) / nodes.size();
    }
    const palpate::Wrench wrench =
      palpate::wrenchOf(greens, prepared.ForcePoints, nodes, solution.traction, centre);
    forces.col(zone) = wrench.force;
    torques.col(zone++) = wrench.torque;
  }
  convert::removeContact(output);
  convert::setPointVectors(output, arrays::Displacement, solution.displacement);
  convert::setPointVectors(output, arrays::Traction, solution.traction);
  convert::setFieldNumber(output, arrays::LargestDisplacementGradient,
    palpate::surfaceGradients(mesh, solution.displacement).largest);
  convert::setFieldVectors(output, arrays::ContactForce, forces);
  convert::setFieldVectors(output, arrays::ContactTorque, torques);
  convert::setFieldNumber(output, arrays::ContactCondition, solution.condition);
}
