// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch/window.h"

#include <vtkCamera.h>
#include <vtkCullerCollection.h>
#include <vtkInteractorStyleHaptic.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <array>
#include <cmath>

#include "picture/picture.h"
#include "picture/png.h"

namespace palpate::app {

Window::Window(bool offScreen) {
  window_->SetOffScreenRendering(offScreen);
  window_->SetMultiSamples(0);
  window_->SetSize(1000, 750);
  window_->SetWindowName("Palpate");
  renderer_->SetBackground(1, 1, 1);
  renderer_->GetCullers()->RemoveAllItems();  // all is in sight
  window_->AddRenderer(renderer_);
  interactor_->SetRenderWindow(window_);
}

Window::~Window() {
  interactor_->SetInteractorStyle(nullptr);
}

void Window::use(vtkInteractorStyleHaptic* style) {
  interactor_->SetInteractorStyle(style);
}

void Window::lookAt(vtkInteractorStyleHaptic* style) {
  lookFrom(Eigen::Vector3d(directionOntoFreeSurface(style->GetTouchedModel()).data()),
           style->GetDeformedSurface()->GetBounds());
}

void Window::lookFrom(const Eigen::Vector3d& towards, const double* bounds) {
  vtkCamera* camera = renderer_->GetActiveCamera();
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(towards.data());
  const bool fromAbove = std::abs(towards.z()) > 0.95 * towards.norm();
  camera->SetViewUp(0, fromAbove ? 1 : 0, fromAbove ? 0 : 1);
  renderer_->ResetCamera(bounds);
}

void Window::render() {
  window_->Render();
}

void Window::write(const std::string& path) {
  render();
  writePng(window_, path);
}

}  // namespace palpate::app
