// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_haptic_touch_h
#define palpate_haptic_touch_h

#include "contact/surface_stiffness.h"
#include "haptics/scripted_device.h"
#include "haptics/servo_loop.h"
#include "loaded_scene.h"
#include "mouse_device.h"
#include "progress.h"

#include <memory>
#include <string>
#include <vector>

class vtkPolyData;

namespace palpate
{
/// A scene's models, devices and servo loop, without anything drawn. What changes the scene stops the loop;
/// settings that the header says take effect at once do not. Throws what a user can mend, with a sentence.
class HapticTouch
{
public:
  HapticTouch();
  ~HapticTouch();

  const palpate::Scene& Scene() const { return this->Loaded.Described; }
  void SetModel(vtkPolyData* model);
  void LoadScene(const std::string& fileName);
  /// @throws what Prepare would, but for a HID device that is not there.
  std::string EvaluationPlan(const ProgressCallback& progress = {});
  /// The first tool; the others stay.
  /// @param radius  of a ball; 0 for a point.
  void SetTool(double radius);
  void SetContactCapacity(int capacity);
  void SetDevice(const SceneDevice& device);
  void SetRate(double rate);
  void SetDeformation(DeformationRows rows);
  void SetRecordFile(const std::string& fileName);
  /// @throws std::invalid_argument for what ForceSafety would refuse.
  void SetSafety(const SafetySettings& safety);

  ///@{ At once.
  void SetFriction(double mu);
  void SetMaskRadius(double radius);
  void SetMaskShape(MaskShape shape);
  void SetStiffnessScale(double scale);
  void SetRigidStiffness(double stiffness);
  void Reset();
  ///@}

  /// Opens the devices and makes model and loop, if that is not done.
  void Prepare();
  void Start();
  void Stop();
  bool IsRunning() const { return this->Loop && this->Loop->isRunning(); }
  void RunHeadless(double seconds);
  /// @throws std::runtime_error if the file cannot be written.
  void WriteRecording();
  /// What to know before relying on the forces, a sentence each; after Prepare.
  std::vector<std::string> Warnings() const;

  /// Takes the newest snapshot. @return whether there is one.
  bool Update();
  void ComputeFrame(const std::vector<std::vector<int>>& visible);
  const Eigen::Matrix3Xd& Displacement(int body) const;

  /// The first model as it was given.
  vtkPolyData* Touched() const;
  const std::vector<SceneBody>& Bodies() const { return this->Loaded.Bodies; }
  /// Under gravity a body's surface has sagged. After Prepare.
  std::shared_ptr<const SurfaceMesh> Mesh(int body) const { return this->Session->mesh(body); }
  const ToolLook& Look(int tool) const { return this->Looks[tool]; }
  /// The newest, until the next Update; empty before the first.
  const ServoSnapshot& Snapshot() const { return this->Latest ? *this->Latest : this->Nothing; }
  const ToolContact& Contact(int tool) const;
  Wrench Rendered(int tool) const;
  bool IsReduced(int tool) const;
  /// What the first body does to another that it meets, N; numbered from 0.
  Eigen::Vector3d PartnerForce(int partner) const;
  std::string Fault(int tool) const;
  /// A line for each tool and fault that there was: how often, and when first.
  std::string FaultTable() const;
  /// What a probe of the scene inside the first model reads by the newest snapshot; null for others.
  const ProbeReading* ProbeInside(int probe) const;
  /// m, of the scene's probes, 3 by their number; zero before the first frame.
  const Eigen::Matrix3Xd& ProbeDisplacements() const;
  std::string Status() const;
  double MaskRadius() const;
  /// Of the vertices of the first body, N/m; NaN where there is none.
  Eigen::VectorXd StiffnessNorms() const;

  std::int64_t Ticks() const;
  std::int64_t MissedTicks() const;
  std::int64_t TruncatedTicks() const;
  double TickTime(double share) const;
  std::string TimingTable() const;
  std::vector<Wrench> ForceTrace() const;

  bool HasMouse() const { return this->Pointer != nullptr; }
  /// @throws std::logic_error if no tool is the mouse's.
  MouseDevice& Mouse();
  const ToolPose& MousePose() const { return this->PointerPose; }
  /// How far the mouse's tool reaches from its position on all sides: a ball's radius.
  double PointerReach() const;
  void SetMousePose(const ToolPose& pose) { this->PointerPose = pose; }

private:
  static constexpr double RecordedSeconds = 120; ///< at most

  void Change();
  std::shared_ptr<HapticDevice> Open(const SceneTool& tool, const SurfaceMesh* mesh);
  std::shared_ptr<HapticDevice> OpenMouse();
  std::vector<std::shared_ptr<const SurfaceMesh>> LoadTools();
  ServoTool OpenHand(const SceneTool& tool, const SurfaceMesh* mesh);
  void BeginSession(const std::vector<std::shared_ptr<const SurfaceMesh>>& meshes);
  void RequireRunnable();
  std::shared_ptr<const SurfaceStiffness> NewStiffness() const;
  std::shared_ptr<const SurfaceStiffness> Bounded(std::shared_ptr<const SurfaceStiffness> stiffness) const;
  void BoundStiffness(const std::vector<ServoTool>& hands,
    const std::vector<std::shared_ptr<const SurfaceMesh>>& meshes);
  double BoundedScale() const;
  void ScaleTools(double scale);
  double MeanEdge() const;

  palpate::Scene& Described() { return this->Loaded.Described; }
  const palpate::Scene& Described() const { return this->Loaded.Described; }

  LoadedScene Loaded;
  std::string RecordFile;
  std::vector<ToolLook> Looks;
  std::vector<bool> Silent; ///< whether a tool's device can render no force
  std::vector<Eigen::Vector3d> Pressed; ///< where simulated hands do
  std::vector<std::string> Cautions;    ///< of the session as it began
  double ToolStiffness = 0; ///< |K| of the stiffest tool with a shape, at a stiffness scale of one; 0 if unknown
  double DeviceStiffness = 0; ///< most that all devices render stably, N/m in the scene; 0 if not known
  std::shared_ptr<MouseDevice> Pointer;
  ToolPose PointerPose;
  std::shared_ptr<ScriptedDevice> FirstScript;
  std::shared_ptr<RecordingDevice> Recorder;
  std::unique_ptr<TouchSession> Session;
  std::unique_ptr<ServoLoop> Loop;
  const ServoSnapshot* Latest = nullptr; ///< the loop's
  ServoSnapshot Nothing;
  Eigen::Matrix3Xd None, NoProbes;
};
} // namespace palpate

#endif
