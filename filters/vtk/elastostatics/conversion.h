// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_conversion_h
#define palpate_conversion_h

#include "vtkType.h"

#include <Eigen/Core>
#include <string>
#include <vector>

class vtkDataObject;
class vtkFieldData;
class vtkPolyData;

/// Between VTK's data and the core's types. Not for wrapping: Eigen stays out of the public headers.
/// All functions throw std::invalid_argument with a sentence for data that cannot be used.
namespace palpate::convert
{
Eigen::Matrix3Xd pointsOf(vtkPolyData* surface);
/// Whether every cell is a triangle.
bool hasOnlyTriangles(vtkPolyData* surface);
/// @throws unless every cell is a triangle.
Eigen::Matrix3Xi trianglesOf(vtkPolyData* surface);
/// Every cell as triangles: polygons as fans, strips cut up; other cells are dropped.
Eigen::Matrix3Xi triangulatedCellsOf(vtkPolyData* surface);
/// Replaces points (double precision) and cells; attributes are left alone.
void setSurface(vtkPolyData* surface, const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xi& triangles);

/// A vertex number that an array gives as a floating-point value.
/// @throws unless it is a whole number from 0 to count - 1; the sentence begins with `what` and `index`.
int vertexNumber(double value, vtkIdType count, const std::string& what, vtkIdType index);
/// The same for any integer.
int wholeNumber(double value, const std::string& what, vtkIdType index);

bool hasField(vtkDataObject* data, const char* name);
/// A number of one-tuple field data.
/// @throws if it is missing; `cure` ends the sentence.
double fieldNumber(vtkDataObject* data, const char* name, const std::string& cure);
void setFieldNumber(vtkDataObject* data, const char* name, double value);
/// One tuple of any numbers.
void setFieldNumbers(vtkDataObject* data, const char* name, const std::vector<double>& values);
void setFieldVector(vtkDataObject* data, const char* name, const Eigen::Vector3d& value);
/// A tuple a column.
/// @throws for values that are not finite, as do setFieldVector and setPointVectors.
void setFieldVectors(vtkDataObject* data, const char* name, const Eigen::Matrix3Xd& values);
void setFieldStrings(vtkDataObject* data, const char* name, const std::vector<std::string>& values);
std::string fieldString(vtkDataObject* data, const char* name);

/// 3 by #points point data, or one number a point.
void setPointVectors(vtkPolyData* surface, const char* name, const Eigen::Matrix3Xd& values);
void setPointNumbers(vtkPolyData* surface, const char* name, const Eigen::VectorXd& values);
/// 3 by 3 each, row by row.
void setPointMatrices(
  vtkPolyData* surface, const char* name, const std::vector<Eigen::Matrix3d>& values);

/// The same, read. NaN stands for no matrix.
/// @throws if there is no such array, with `cure` at the sentence's end.
std::vector<Eigen::Matrix3d> pointMatricesOf(
  vtkPolyData* surface, const char* name, const std::string& cure);

/// The 0/1 values of the BoundaryType array; all free if `optional` and there is none.
std::vector<unsigned char> boundaryTypesOf(vtkPolyData* surface, bool optional);
void setBoundaryTypes(vtkPolyData* surface, const std::vector<unsigned char>& types);

/// Takes out of the field data what belongs to Green's functions, which another mesh would not have.
void removeGreensFunctions(vtkDataObject* data);
/// Takes away what a contact left, which another contact would not have.
void removeContact(vtkPolyData* surface);
/// Takes away what contacts left and all stiffnesses, which another model would not have.
void removeResponses(vtkPolyData* surface);
/// Takes away all of this, vertex areas and how an original surface lies on this one, which another mesh
/// would not have.
void removeMeshResults(vtkPolyData* surface);
} // namespace palpate::convert

#endif
