// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "touch/touch_window.h"

#include <read_files.h>
#include <vtkCallbackCommand.h>
#include <vtkDoubleArray.h>
#include <vtkInteractorStyleHaptic.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "haptics/force_safety.h"
#include "picture/virtual_display.h"
#include "progress_bar.h"
#include "touch/window.h"
#include "whole_file.h"

namespace palpate::app {

constexpr double kLongestModel = 20;  ///< m

void require(bool done, vtkInteractorStyleHaptic* style) {
  if (!done) throw std::runtime_error(style->GetFailureMessage());
}

void warnOfUnits(vtkPolyData* model) {
  if (model->GetLength() > kLongestModel) {
    std::cerr << "palpate: warning: the model is " << model->GetLength()
              << " m long: its points are taken for metres; are they millimetres?\n";
    return;
  }
  const double* box = model->GetBounds();
  double farthest = 0;
  for (int k = 0; k < 6; ++k) farthest = std::max(farthest, std::abs(box[k]));
  if (farthest > SafetySettings().largestReach)
    std::cerr << "palpate: warning: the model lies up to " << farthest
              << " m from the origin: devices reach " << SafetySettings().largestReach
              << " m, unless a scene maps them there\n";
}

void requireUninterrupted(const TouchOptions& options) {
  if (options.isInterrupted()) throw std::runtime_error("interrupted; nothing was written");
}

namespace {

/// Errors are thrown, and warnings printed as the program's own.
void silenceAll(vtkInteractorStyleHaptic* style) {
  silence(style);
  vtkNew<vtkCallbackCommand> nothing;
  nothing->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  style->AddObserver(vtkCommand::WarningEvent, nothing);
}

constexpr long long kTicksPerPiece = 100;

void setDevice(vtkInteractorStyleHaptic* style, const std::string& device) {
  unsigned vendor = 0, product = 0;
  int read = 0;
  if (device == "mouse") return require(style->SetDeviceToMouse(), style);
  if (device == "simulated") return require(style->SetDeviceToSimulated(), style);
  if (device.rfind("scripted:", 0) == 0)
    return require(style->SetDeviceToScript(device.substr(9).c_str()), style);
  if (device == "hid") return require(style->SetDeviceToHid(0, 0), style);
  if (std::sscanf(device.c_str(), "hid:%4x:%4x%n", &vendor, &product, &read) == 2 &&
      device.c_str()[read] == '\0')
    return require(style->SetDeviceToHid(static_cast<int>(vendor), static_cast<int>(product)),
                   style);
  throw std::invalid_argument("there is no device '" + device +
                              "': choose mouse, scripted:FILE, simulated, hid or hid:VVVV:PPPP");
}

int deformationMode(const std::string& name) {
  const char* const names[] = {"all", "visible", "contact", "none"};
  for (int mode = 0; mode < 4; ++mode)
    if (name == names[mode]) return mode;
  return 0;
}

void configure(vtkInteractorStyleHaptic* style, const TouchOptions& options) {
  if (!options.scene.empty())
    require(style->LoadScene(options.scene.c_str()), style);
  else
    require(style->SetModel(readSurface(options.model)), style);
  if (options.scene.empty() || options.deviceGiven) setDevice(style, options.device);
  if (options.toolRadius != 0) require(style->SetToolToSphere(options.toolRadius), style);
  if (options.contacts != 0) require(style->SetContactCapacity(options.contacts), style);
  if (options.friction >= 0) require(style->SetFriction(options.friction), style);
  if (options.maskRadius >= 0) require(style->SetMaskRadius(options.maskRadius), style);
  if (!options.maskShape.empty()) require(style->SetMaskShape(options.maskShape.c_str()), style);
  if (options.stiffnessLimit >= 0) require(style->SetRigidStiffness(options.stiffnessLimit), style);
  if (options.rate != 0) require(style->SetServoRate(options.rate), style);
  if (!options.deformation.empty())
    require(style->SetDeformation(deformationMode(options.deformation)), style);
  if (!options.record.empty()) require(style->SetRecordFileName(options.record.c_str()), style);
  warnOfUnits(style->GetTouchedModel());
}

void writeForces(vtkInteractorStyleHaptic* style, const std::string& path) {
  vtkNew<vtkDoubleArray> trace;
  style->GetForceTrace(trace);
  writeWholeFile(path, [&trace](std::ostream& file) {
    file.precision(17);
    file << "force_x,force_y,force_z,torque_x,torque_y,torque_z\n";
    for (vtkIdType i = 0; i < trace->GetNumberOfTuples(); ++i)
      for (int c = 0; c < 6; ++c) file << trace->GetComponent(i, c) << (c < 5 ? "," : "\n");
  });
}

/// What a probe inside has borne.
void printInside(vtkInteractorStyleHaptic* style, int probe, const std::string& name) {
  const double gradient = style->GetLargestProbeDisplacementGradient(probe);
  if (gradient == 0) return;
  std::printf(
      "         von Mises stress %.6g Pa, at most %.6g Pa; displacement gradient at most %.3g\n",
      style->GetProbeVonMisesStress(probe), style->GetLargestProbeVonMisesStress(probe), gradient);
  std::fflush(stdout);
  if (const double time = style->GetProbeLimitTime(probe); time >= 0)
    std::cerr << "palpate: warning: a limit of the probe " << name << " was first exceeded at "
              << time << " s\n";
}

void printProbes(vtkInteractorStyleHaptic* style) {
  for (int probe = 0; probe < style->GetNumberOfProbes(); ++probe) {
    double u[3];
    style->GetProbeDisplacement(probe, u);
    const std::string name = style->GetProbeName(probe);
    std::cout << "probe " << name << "   displacement " << u[0] << " " << u[1] << " " << u[2]
              << " m\n";
    printInside(style, probe, name);
  }
}

/// What safety let through, where that is less.
void printRendered(vtkInteractorStyleHaptic* style, int tool, const double* force) {
  double rendered[3];
  style->GetRenderedForce(tool, rendered);
  const double wanted = std::hypot(force[0], force[1], force[2]);
  if (std::hypot(rendered[0], rendered[1], rendered[2]) >= 0.999 * wanted) return;
  for (double& component : rendered) component += 0.0;  // no negative zeros
  std::printf("         rendered %.6g %.6g %.6g N, limited or faded for safety\n", rendered[0],
              rendered[1], rendered[2]);
}

/// Forces between bodies.
void printPartners(vtkInteractorStyleHaptic* style) {
  for (int partner = 0; partner < style->GetNumberOfPartners(); ++partner) {
    double force[3];
    style->GetPartnerForce(partner, force);
    for (double& component : force) component += 0.0;  // no negative zeros
    std::printf("body %d   force %.6g %.6g %.6g N, of body 0\n", partner + 1, force[0], force[1],
                force[2]);
  }
}

void printState(vtkInteractorStyleHaptic* style) {
  std::cout << style->GetStatus() << "\n";
  for (int tool = 0; tool < style->GetNumberOfTools(); ++tool) {
    double force[3], torque[3], at[3];
    style->GetForce(tool, force);
    style->GetTorque(tool, torque);
    for (double* vector : {force, torque})
      for (int k = 0; k < 3; ++k) vector[k] += 0.0;  // no negative zeros
    style->GetContactPoint(tool, at);
    std::printf("tool %d   force %.6g %.6g %.6g N", tool, force[0], force[1], force[2]);
    if (style->HasTorques())
      std::printf("   torque %.6g %.6g %.6g N m", torque[0], torque[1], torque[2]);
    std::printf("\n");
    if (style->IsTouching(tool)) std::printf("         at %.6g %.6g %.6g\n", at[0], at[1], at[2]);
    printRendered(style, tool, force);
  }
  printPartners(style);
  std::fflush(stdout);
  printProbes(style);
  std::cout << style->GetFaultTable() << std::flush;
  std::printf("ticks    %lld, %lld left out\n", static_cast<long long>(style->GetNumberOfTicks()),
              static_cast<long long>(style->GetNumberOfMissedTicks()));
  if (style->GetNumberOfTruncatedTicks() > 0)
    std::printf(
        "         %lld with contacts left out, whose force is too small: raise --contacts, or a "
        "scene's solver.capacity\n",
        static_cast<long long>(style->GetNumberOfTruncatedTicks()));
  std::cout << style->GetTimingTable() << std::flush;
}

/// Of what the style found when it began to touch, and as it ended.
class Warnings {
 public:
  /// Says what has not been said yet.
  void print(vtkInteractorStyleHaptic* style) {
    const std::string all = style->GetWarnings();
    std::istringstream fresh(all.substr(std::min(said_, all.size())));
    said_ = all.size();
    for (std::string line; std::getline(fresh, line);)
      std::cerr << "palpate: warning: " << line << "\n";
  }

 private:
  std::size_t said_ = 0;
};

/// In pieces, between which it can be interrupted.
void tickThrough(vtkInteractorStyleHaptic* style, const TouchOptions& options) {
  const double rate = style->GetServoRate();
  const long long ticks = std::llround(options.seconds * rate);
  for (long long done = 0; done < ticks; done += kTicksPerPiece) {
    requireUninterrupted(options);
    require(style->RunHeadless(std::min(kTicksPerPiece, ticks - done) / rate), style);
  }
  requireUninterrupted(options);
}

void runHeadless(const TouchOptions& options) {
  std::unique_ptr<VirtualDisplay> display;
  std::unique_ptr<Window> window;
  vtkNew<vtkInteractorStyleHaptic> style;
  silenceAll(style);
  if (!options.image.empty()) {
    display = std::make_unique<VirtualDisplay>();
    window = std::make_unique<Window>(true);
    window->use(style);
  }
  configure(style, options);
  require(style->RunHeadless(0), style);
  Warnings warnings;
  warnings.print(style);
  if (window) window->lookAt(style);
  tickThrough(style, options);
  require(style->Stop(), style);
  warnings.print(style);
  if (!options.forces.empty()) writeForces(style, options.forces);
  if (window) window->write(options.image);
  printState(style);
  if (options.waitsForMouse)
    std::cout << "nothing moved the mouse's tool, which needs a window: --device simulated presses "
                 "and lifts, --device scripted:FILE replays a recording\n"
              << std::flush;
}

/// Ends an interactor after some time, or when it is interrupted.
struct Clock {
  const TouchOptions& options;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  static void look(vtkObject* caller, unsigned long, void* self, void*) {
    const auto& [options, start] = *static_cast<Clock*>(self);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    const bool isOver = options.seconds > 0 && passed.count() >= options.seconds;
    if (isOver || options.isInterrupted())
      static_cast<vtkRenderWindowInteractor*>(caller)->TerminateApp();
  }
};

/// Until the window is closed, the time is over, or it is interrupted: then all is still written.
void touchInWindow(Window& window, vtkInteractorStyleHaptic* style, const TouchOptions& options,
                   Warnings& warnings) {
  // No force may outlive the display, and no recording be lost with it.
  const OnDisplayLoss stopping([style] { style->Stop(); });
  require(style->Start(), style);
  warnings.print(style);
  window.lookAt(style);
  Clock clock{options};
  vtkNew<vtkCallbackCommand> look;
  look->SetCallback(&Clock::look);
  look->SetClientData(&clock);
  window.interactor()->AddObserver(vtkCommand::TimerEvent, look);
  window.interactor()->Start();
  window.interactor()->RemoveObserver(look);
}

}  // namespace

void runWindow(const TouchOptions& options) {
  if (options.plan) {
    vtkNew<vtkInteractorStyleHaptic> style;
    silenceAll(style);
    configure(style, options);
    vtkNew<vtkCallbackCommand> progress;
    progress->SetCallback([](vtkObject*, unsigned long, void*, void* fraction) {
      drawProgress(*static_cast<double*>(fraction), "rehearse");
    });
    style->AddObserver(vtkCommand::ProgressEvent, progress);
    const std::string plan = style->GetEvaluationPlan();
    endProgressBar();
    require(!plan.empty(), style);
    std::cout << plan << std::flush;
    return;
  }
  if (options.headless) return runHeadless(options);
  if (!hasDisplay())
    throw std::runtime_error(
        "there is no display for a window: set DISPLAY to one, or run with --headless --seconds N");
  Window window(false);
  vtkNew<vtkInteractorStyleHaptic> style;
  silenceAll(style);
  window.use(style);
  configure(style, options);
  window.interactor()->Initialize();
  Warnings warnings;
  touchInWindow(window, style, options, warnings);
  require(style->Stop(), style);
  warnings.print(style);
  style->Update();
  if (!options.forces.empty()) writeForces(style, options.forces);
  printState(style);
}

}  // namespace palpate::app

/// The library's one entry.
extern "C" __attribute__((visibility("default"))) std::string palpate_touch(
    const palpate::app::TouchOptions& options) {
  try {
    if (options.grasp)
      palpate::app::runGrasp(options);
    else if (options.lab)
      palpate::app::runLab(options);
    else
      palpate::app::runWindow(options);
    return {};
  } catch (const std::exception& failure) {
    return failure.what();
  }
}
