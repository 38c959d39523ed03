// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkInteractorStyleHaptic
 * @brief touches an elastic surface in a render window
 *
 * An interactor style for any vtkRenderWindowInteractor. It owns the devices and the servo loop, which
 * evaluates contact forces at its own rate whatever the window does, and at the window's rate draws what
 * the latest tick left: the deformed surface, the tools, a status line; and, seen through the surface, the
 * three places of a point's contact, the force on the hand as an arrow (a hand's as one a finger), the nodes
 * that bear it.
 *
 * By default the mouse touches with a point: the left button, on the surface, brings the probe there and
 * presses it in by PressDepth; dragging moves it in the plane of the view, the wheel deeper or out, with
 * Control it adheres and pulls. The right button turns the camera, the middle one moves it. A scene file
 * (LoadScene) has other devices, tools and effects; its format is told in core/haptics/scene.h.
 *
 * Keys: [ and ] less and more friction, , and . a smaller and larger mask, - and + softer and stiffer,
 * w wireframe, s surface, v the stiffness as colours, n lets all contact begin anew, r resets camera and
 * contact.
 *
 * D. L. James and D. K. Pai 2001, sections 6 and 7, figures 8 and 9. Needs the Green's functions of any
 * filter that makes them, as vtkBoundaryElementGreensFunctions, but of no exterior. Methods that can fail
 * return false and leave a sentence in GetFailureMessage().
 */

#ifndef vtkInteractorStyleHaptic_h
#define vtkInteractorStyleHaptic_h

#include "PalpateHapticsModule.h"
#include "vtkInteractorStyleTrackballCamera.h"

#include <memory>
#include <string>

class vtkDoubleArray;
class vtkPolyData;

class PALPATEHAPTICS_EXPORT vtkInteractorStyleHaptic : public vtkInteractorStyleTrackballCamera
{
public:
  static vtkInteractorStyleHaptic* New();
  vtkTypeMacro(vtkInteractorStyleHaptic, vtkInteractorStyleTrackballCamera);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Events that an observer hears of from Update(): a tool begins or ends to touch, a device or solve
   * fails (GetFault tells how), a probe inside the body exceeds one of its limits for the first time. Its
   * call data is the number of the tool or probe, an int.
   */
  enum HapticEvents
  {
    ContactBeginEvent = 11001,
    ContactEndEvent,
    FaultEvent,
    ThresholdEvent
  };

  /**
   * The surface to touch, with its Green's functions. Stops.
   */
  bool SetModel(vtkPolyData* model);
  /**
   * Models, tools, devices and effects from a JSON file, in place of all that was set. Stops.
   */
  bool LoadScene(const char* fileName);
  /**
   * What a tick and a frame of the scene will compute, as a table. Empty on failure. What tools with a shape
   * compute is rehearsed, which may take seconds: ProgressEvent tells how far it is.
   */
  std::string GetEvaluationPlan();

  ///@{
  /**
   * The first tool: a point (default), or a ball of a radius in the unit of the points. A scene's further
   * tools stay; points and tools with a shape do not go together. Stops.
   */
  bool SetToolToPoint();
  bool SetToolToSphere(double radius);
  ///@}

  ///@{
  /**
   * What moves the first tool: the mouse (default); a recording, a moment a tick, refused if it states
   * another rate than the servo loop's; a simulated hand that presses and lifts every two seconds, where the
   * model is farthest from its support; a HID device by its numbers, or the first there is for zeros. Stops.
   */
  bool SetDeviceToMouse();
  bool SetDeviceToScript(const char* fileName);
  bool SetDeviceToSimulated();
  bool SetDeviceToHid(int vendor, int product);
  ///@}

  ///@{
  /**
   * Coulomb's mu, >= 0 (default 0.3). Takes effect at once.
   */
  bool SetFriction(double mu);
  double GetFriction();
  ///@}

  ///@{
  /**
   * Radius of a point's pressure mask, in the unit of the points (default: two mean edges of the model).
   * Takes effect at once; the vertices' stiffnesses are computed anew, Green's functions are not.
   */
  bool SetMaskRadius(double radius);
  double GetMaskRadius();
  ///@}

  ///@{
  /**
   * The functional of a point's pressure mask over its radius: "linear" (default, the paper's), "uniform",
   * "gaussian" or "hertzian". Takes effect at once, as the radius.
   */
  bool SetMaskShape(const char* name);
  std::string GetMaskShape();
  ///@}

  ///@{
  /**
   * By what all forces are scaled, positive (default 1). Takes effect at once.
   */
  bool SetStiffnessScale(double scale);
  double GetStiffnessScale();
  ///@}

  ///@{
  /**
   * k_Rigid, N/m, the stiffness of fixed vertices, to points and tools with a shape: points show none of a
   * larger Frobenius norm than theirs, sqrt(3) k_Rigid. 0 (default) for the stiffest free vertex, to tools with
   * a shape ten times Young's modulus times the mean edge. Takes effect at once. A device that states what
   * stiffness it renders stably bounds the Frobenius norm further, by that.
   */
  bool SetRigidStiffness(double stiffness);
  double GetRigidStiffness();
  ///@}

  ///@{
  /**
   * Most contacts of tools with a shape at a time, up to 2000; 0 (default) for as many as the model has
   * vertices, from 128 to 500. Beyond them the force is too small, and GetStatus says so. Stops.
   */
  bool SetContactCapacity(int capacity);
  int GetContactCapacity();
  ///@}

  ///@{
  /**
   * Whose displacements a frame computes: all (default), those of vertices that face the camera, those
   * that bear a force, none. Stops.
   */
  enum DeformationModes
  {
    DEFORM_ALL = 0,
    DEFORM_VISIBLE = 1,
    DEFORM_CONTACT = 2,
    DEFORM_NONE = 3
  };
  bool SetDeformation(int mode);
  int GetDeformation();
  ///@}

  ///@{
  /**
   * Ticks a second, 250 to 10000 (default 1000). Stops.
   */
  bool SetServoRate(double rate);
  double GetServoRate();
  ///@}

  ///@{
  /**
   * What may be done to a hand: the largest force, N (default 3), its largest change, N/s (1000), and the
   * time from nothing to the whole force after a start or a fault, s (0.5). No device is asked for more than it
   * says it renders; the mouse renders nothing and has no limits. Stops.
   */
  bool SetLargestForce(double force);
  double GetLargestForce();
  bool SetForceSlew(double slew);
  double GetForceSlew();
  bool SetForceRamp(double seconds);
  double GetForceRamp();
  ///@}

  ///@{
  /**
   * How deep the mouse presses at first, in diagonals of the body, 0 to 1 (default 0.02).
   */
  bool SetPressDepth(double depth);
  vtkGetMacro(PressDepth, double);
  ///@}

  ///@{
  /**
   * Frames a second that a running style asks of the interactor, 1 to 240 (default 60).
   */
  bool SetFrameRate(double rate);
  vtkGetMacro(FrameRate, double);
  ///@}

  ///@{
  /**
   * A file that Stop writes the first device's motion to with its rate, whole or not at all; none by
   * default. It holds 120 s: what comes later is left out, and Stop warns of it. For SetDeviceToScript. Stops.
   * False without a folder to write it to.
   */
  bool SetRecordFileName(const char* fileName);
  ///@}

  /**
   * Starts the devices, the servo loop and, with an interactor, the frames.
   */
  bool Start();
  /**
   * Fades all forces and stops; false if a recording could not be written.
   */
  bool Stop();
  bool IsRunning();

  /**
   * Ticks on virtual time instead, from where the last call ended, as fast as they compute: with scripted
   * or simulated devices the same each time, bit for bit. At most a day. Then updates.
   */
  bool RunHeadless(double seconds);

  /**
   * Takes over the latest tick's state: points, props, events. The frames of a running style call it.
   */
  void Update();

  /**
   * Puts the mouse's probe at a place of the scene, as dragging does; `adheres` to pull. For scripts and tests.
   */
  bool MoveProbe(double x, double y, double z, bool adheres = false);

  ///@{
  /**
   * The state at the last Update, of one tool.
   */
  int GetNumberOfTools();
  bool IsTouching(int tool = 0);
  bool IsSliding(int tool = 0);
  /** What the model does to the tool, before the limits of safety, N. */
  void GetForce(int tool, double force[3]);
  /** About the tool's position, N m; zero unless HasTorques. */
  void GetTorque(int tool, double torque[3]);
  /** What the device rendered, in its own frame, N. */
  void GetRenderedForce(int tool, double force[3]);
  void GetToolPosition(int tool, double position[3]);
  /** On the undeformed surface. */
  void GetContactPoint(int tool, double point[3]);
  /** The last fault, in words; empty without one. */
  std::string GetFault(int tool = 0);
  /** Whether torques are computed: a scene's "torque", of tools with a shape. */
  bool HasTorques();
  ///@}

  ///@{
  /**
   * A scene's other bodies, and what the first one does to each at the last Update, N.
   */
  int GetNumberOfPartners();
  void GetPartnerForce(int partner, double force[3]);
  ///@}

  ///@{
  /**
   * A scene's probes in its order, and their displacements at the last Update, m.
   */
  int GetNumberOfProbes();
  std::string GetProbeName(int probe);
  void GetProbeDisplacement(int probe, double displacement[3]);
  ///@}

  ///@{
  /**
   * Of a scene's probe inside the body, by contact alone, at the last Update and the largest of any tick
   * up to there: von Mises stress (Pa) and spectral norm of the displacement gradient, from 0.1 of which
   * on linear theory is not to be trusted. 0 for a probe on the surface.
   */
  double GetProbeVonMisesStress(int probe);
  double GetProbeDisplacementGradient(int probe);
  double GetLargestProbeVonMisesStress(int probe);
  double GetLargestProbeDisplacementGradient(int probe);
  ///@}

  /**
   * When, in seconds of the servo loop, a probe's limit was first exceeded; -1 if it was not.
   */
  double GetProbeLimitTime(int probe);

  /**
   * A line for each tool and kind of fault up to the last Update: how many ticks it lasted, and its first
   * tick. Empty without any.
   */
  std::string GetFaultTable();

  /**
   * What to know before relying on the forces, a line each: Green's functions that are missing, tools that
   * the mesh is too coarse for, a recording that was too long. A warning tells each of them once. Empty
   * before the first start.
   */
  std::string GetWarnings();

  ///@{
  /**
   * Of the last solve: its residual relative to the forces, contacts that bear a force.
   */
  double GetResidual();
  int GetNumberOfContacts();
  ///@}

  ///@{
  /**
   * Of the loop so far: ticks, ticks left out, ticks with more contacts than there is room for, and the
   * computing time that a share of the ticks does not exceed, s. The table tells more.
   */
  vtkIdType GetNumberOfTicks();
  vtkIdType GetNumberOfMissedTicks();
  vtkIdType GetNumberOfTruncatedTicks();
  double GetTickTime(double share);
  std::string GetTimingTable();
  ///@}

  /**
   * The first model as it was given or read; null without one.
   */
  vtkPolyData* GetTouchedModel();
  /**
   * A body as it is drawn; its points move with each Update.
   */
  vtkPolyData* GetDeformedSurface(int body = 0);

  /**
   * Force and torque on the hand, six components, a tuple for each moment that the first device, a
   * scripted one, has replayed. Nothing for other devices, or while it runs.
   */
  void GetForceTrace(vtkDoubleArray* trace);

  std::string GetStatus();
  vtkGetMacro(FailureMessage, std::string);

  // The style's part in the interactor's events.
  void SetInteractor(vtkRenderWindowInteractor* interactor) override;
  void OnTimer() override;
  void OnMouseMove() override;
  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;
  void OnRightButtonDown() override;
  void OnRightButtonUp() override;
  void OnMouseWheelForward() override;
  void OnMouseWheelBackward() override;
  void OnChar() override;

protected:
  vtkInteractorStyleHaptic();
  ~vtkInteractorStyleHaptic() override;

private:
  vtkInteractorStyleHaptic(const vtkInteractorStyleHaptic&) = delete;
  void operator=(const vtkInteractorStyleHaptic&) = delete;

  struct Touch;
  template <class Action>
  bool Try(const Action& action);
  void Prepare();
  void Warn();
  void ShowIn(vtkRenderer* renderer);
  void Announce();
  void Drag();
  void TurnWheel(double notches);
  void Render();

  std::unique_ptr<Touch> Internals;
  double PressDepth = 0.02, FrameRate = 60;
  std::string FailureMessage;
};

#endif
