// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

#include <vtkNew.h>

#include <Eigen/Core>
#include <string>

class vtkInteractorStyleHaptic;
class vtkRenderer;
class vtkRenderWindow;
class vtkRenderWindowInteractor;

namespace palpate::app {

/// A render window with an interactor, for the eye or for pictures.
class Window {
 public:
  explicit Window(bool offScreen);
  ~Window();
  void use(vtkInteractorStyleHaptic* style);
  /// Onto the free part of what the style touches.
  void lookAt(vtkInteractorStyleHaptic* style);
  /// @param towards  from the object to the eye.
  /// @param bounds   that the view holds, as vtkPolyData::GetBounds.
  void lookFrom(const Eigen::Vector3d& towards, const double* bounds);
  void render();
  /// @throws std::runtime_error if the file cannot be written.
  void write(const std::string& path);
  vtkRenderWindowInteractor* interactor() { return interactor_; }
  vtkRenderer* renderer() { return renderer_; }

 private:
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
};

/// @throws std::runtime_error with the style's sentence unless `done`.
void require(bool done, vtkInteractorStyleHaptic* style);

}  // namespace palpate::app
