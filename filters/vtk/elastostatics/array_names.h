// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_array_names_h
#define palpate_array_names_h

/// The names of all arrays that Palpate reads and writes, with their place, type and unit. Lengths are
/// in the unit of the points (SI: metres), pressures in that of Young's modulus (SI: pascals).
namespace palpate::arrays
{
// Point data.
constexpr const char* BoundaryType = "BoundaryType"; // uint8: 0 free, 1 fixed
constexpr const char* VertexArea = "VertexArea";     // m^2
constexpr const char* Displacement = "Displacement"; // 3, m
constexpr const char* Traction = "Traction";         // 3, Pa
constexpr const char* PressureMask = "PressureMask"; // 1/m^2
constexpr const char* TorqueMask = "TorqueMask";     // 9, row by row, Pa per N m: 1/m^3
constexpr const char* Stiffness = "Stiffness";       // 9, row by row, N/m
constexpr const char* StiffnessNorm = "StiffnessNorm";           // Frobenius, N/m
constexpr const char* StiffnessAsymmetry = "StiffnessAsymmetry"; // before symmetrising, relative
constexpr const char* StiffnessLimited = "StiffnessLimited"; // 1 where that of the mask's mean limits it
constexpr const char* RotationalStiffness = "RotationalStiffness"; // 9, row by row, N m/rad
// Shares of a mask by area; point data of all masks, field data of one.
constexpr const char* MaskSupportShare = "MaskSupportShare"; // what would have been on fixed vertices
constexpr const char* MaskBeyondShare = "MaskBeyondShare";   // on other components and far sides
constexpr const char* HapticRatio = "HapticRatio";               // |K^H| / |K^E|
// Point data of vtkStiffnessArtifacts; NaN where there is no elastic stiffness, vectors zero.
constexpr const char* HapticStiffness = "HapticStiffness"; // 9, row by row, K^H, N/m
constexpr const char* SingleVertexStiffnessNorm = "SingleVertexStiffnessNorm"; // without mask, N/m
constexpr const char* StiffnessCondition = "StiffnessCondition"; // stiffest over softest direction
constexpr const char* PrincipalStiffness1 = "PrincipalStiffness1"; // 3, the stiffest axis, as long as N/m
constexpr const char* PrincipalStiffness2 = "PrincipalStiffness2";
constexpr const char* PrincipalStiffness3 = "PrincipalStiffness3";
constexpr const char* SmoothStiffnessNorm = "SmoothStiffnessNorm"; // smooth part of StiffnessNorm, N/m
constexpr const char* StiffnessArtifact = "StiffnessArtifact"; // StiffnessNorm over its smooth part, - 1
constexpr const char* SingleVertexArtifact = "SingleVertexArtifact"; // the same of single vertices
constexpr const char* StiffnessJump = "StiffnessJump";     // largest of the vertex's edges, relative
constexpr const char* StiffnessChange = "StiffnessChange"; // over that of the reference, - 1

// Point data of vtkInteriorProbe; Displacement, too.
constexpr const char* InsideMaterial = "InsideMaterial";     // 1 inside, 0 elsewhere
constexpr const char* EdgesFromSurface = "EdgesFromSurface"; // distance in mean edges

// Cell data of vtkSurfaceStress, point data of vtkInteriorProbe.
constexpr const char* Strain = "Strain";                 // 6: xx, yy, zz, xy, yz, xz
constexpr const char* Stress = "Stress";                 // 6, the same, Pa
constexpr const char* VonMisesStress = "VonMisesStress"; // Pa
constexpr const char* PrincipalStress = "PrincipalStress"; // 3, the largest first, Pa

// Point data of models on springs, see vtkElasticFoundation.
constexpr const char* SpringStiffness = "SpringStiffness"; // 1 or 9, row by row, N/m

// Point data of shells.
constexpr const char* Thickness = "Thickness"; // m; cell data, too, and then one a triangle
/// uint8, 6: displacement along x, y, z and rotation about them held, besides what fixed vertices hold (of
/// solids the first 3); where all of the displacement is, a shell's vertex is fixed, its rotation as here.
constexpr const char* HeldComponents = "HeldComponents";

// Cell data.
constexpr const char* SmoothPatch = "SmoothPatch"; // int, traction may jump between patches

// Field data: material and reference problem.
constexpr const char* SmoothAngle = "SmoothAngle"; // degrees; SmoothPatch was found by it, not given
constexpr const char* YoungsModulus = "YoungsModulus"; // Pa
constexpr const char* PoissonRatio = "PoissonRatio";

// Cell data of a volume mesh, the second input of vtkFiniteElementGreensFunctions; YoungsModulus and
// PoissonRatio, too.
constexpr const char* TransverselyIsotropicModuli =
  "TransverselyIsotropicModuli"; // 5: E (Pa), nu along, E, nu across, G along the fibres
constexpr const char* FibreDirection = "FibreDirection"; // 3, of any length but zero
constexpr const char* OrthotropicModuli = "OrthotropicModuli"; // 9: E 1, 2, 3; nu 12, 13, 23; G 12, 13, 23
constexpr const char* MaterialAxes = "MaterialAxes"; // 6: directions of axes 1 and 2
constexpr const char* ElasticityTensor = "ElasticityTensor"; // 21, upper triangle row by row, Pa
constexpr const char* Density = "Density"; // kg/m^3; field data of a model, too: the mean

// Field data: Green's functions.
/// 3 #points components a tuple, one tuple a column of Xi (three a node of GreensFunctionNodes); rows
/// are metres where free, pascals where fixed, per pascal of a free or metre of a fixed column. There
/// is no such array where they are computed when asked for, as those of half-spaces are.
constexpr const char* GreensFunctions = "GreensFunctions"; // double or float
constexpr const char* GreensFunctionNodes = "GreensFunctionNodes"; // id
/// The same for tractions on single patches of vertices on sharp edges, and (node, patch) of each.
constexpr const char* PatchGreensFunctions = "PatchGreensFunctions";
constexpr const char* PatchGreensFunctionNodes = "PatchGreensFunctionNodes"; // 2, id
/// What a weight of 1 N/m^3 in the mean does, three tuples like those of GreensFunctions, one an axis:
/// metres where free, pascals where fixed. Where it is missing, boundary elements' models find it.
constexpr const char* WeightResponse = "WeightResponse";
/// Points inside as rows: 13 a point and component a tuple, three tuples a node, per pascal:
/// displacement, its gradient row by row, and what of the mean stress (Pa) the strain does not tell;
/// their places (3, m) and stiffnesses (36, Pa, Voigt: xx, yy, zz, yz, xz, xy), a tuple a point.
constexpr const char* ProbeGreensFunctions = "ProbeGreensFunctions";
constexpr const char* ProbePoints = "ProbePoints";
constexpr const char* ProbeStiffness = "ProbeStiffness";
/// 22 a triangle of a body of several or anisotropic materials: the upper triangle, row by row, of the
/// stiffness behind it, Pa, and where nearly incompressible 1 / lambda, else -1.
constexpr const char* SurfaceElasticity = "SurfaceElasticity";
/// Young's modulus that the stored functions were computed with; YoungsModulus scales what is served.
constexpr const char* GreensFunctionYoungsModulus = "GreensFunctionYoungsModulus"; // Pa
constexpr const char* GreensFunctionSource = "GreensFunctionSource";               // string
constexpr const char* HomogeneousMaterial = "HomogeneousMaterial"; // 0, or absent
/// interior, exterior, halfspace, shell, given or unsupported
constexpr const char* GreensFunctionDomain = "GreensFunctionDomain";
constexpr const char* Clamped = "Clamped"; // of shells: 1 fixed vertices do not turn, 0 they do
constexpr const char* GreensFunctionsReciprocal = "GreensFunctionsReciprocal"; // uint8
constexpr const char* MeshFingerprint = "MeshFingerprint";                     // uint64

// Field data: diagnostics of the Green's functions (see palpate::Diagnostics), -1 for not measured.
constexpr const char* ConditionEstimate = "ConditionEstimate";
constexpr const char* ReciprocityDefect = "ReciprocityDefect";
constexpr const char* RotationDefect = "RotationDefect";
constexpr const char* SolverResidual = "SolverResidual";
constexpr const char* IntegrationTolerance = "IntegrationTolerance";
constexpr const char* WallRatio = "WallRatio";
constexpr const char* SupportWidth = "SupportWidth";
constexpr const char* RockingCompliance = "RockingCompliance"; // rad/(N m)
// Estimated relative errors (see palpate::ErrorEstimate): all causes; of contact compliances; what 95 %
// of the loads do not exceed in either; by cause; and the length that loads are spread over.
constexpr const char* ErrorEstimate = "ErrorEstimate";
constexpr const char* ContactErrorEstimate = "ContactErrorEstimate";
constexpr const char* MostErrorEstimate = "MostErrorEstimate";
constexpr const char* DiscretizationError = "DiscretizationError";
constexpr const char* IntegrationError = "IntegrationError";
constexpr const char* SolverError = "SolverError";
constexpr const char* StorageError = "StorageError";
constexpr const char* ErrorLoadLength = "ErrorLoadLength"; // m
constexpr const char* ToleranceSteps = "ToleranceSteps";   // strings, of vtkToleranceGreensFunctions
constexpr const char* PeakBytes = "PeakBytes";
constexpr const char* StageSeconds = "StageSeconds"; // one tuple a stage
constexpr const char* StageNames = "StageNames";     // strings
constexpr const char* Warnings = "Warnings";         // strings
constexpr const char* RepairChanges = "RepairChanges"; // strings

// Field data: contacts.
constexpr const char* ContactForce = "ContactForce";   // 3 a zone, on the body, N
constexpr const char* ContactTorque = "ContactTorque"; // 3 a zone, about the zone's centroid, N m
constexpr const char* ContactRotation = "ContactRotation"; // 3, mean under the mask, rad
constexpr const char* ContactCondition = "ContactCondition"; // of the capacitance matrix
/// Of the surface's displacement gradients the largest spectral norm; from 0.1 on linear theory is not
/// to be trusted.
constexpr const char* LargestDisplacementGradient = "LargestDisplacementGradient";
constexpr const char* ContactPoint = "ContactPoint";               // 3, x^C of [JP01] fig. 8, m
constexpr const char* ElasticContactPoint = "ElasticContactPoint"; // 3, x^E, m
constexpr const char* HapticContactPoint = "HapticContactPoint";   // 3, x^H, m

// Of vtkContactRecovery, besides Displacement and Traction. Point data:
constexpr const char* ContactPressure = "ContactPressure"; // of the traction, into the body, Pa
constexpr const char* ContactPressureDeviation = "ContactPressureDeviation"; // standard, by noise, Pa
constexpr const char* ContactNumber = "ContactNumber"; // int, from 1 with the strongest; 0 none
// Field data, a tuple a contact, besides ContactForce and ContactTorque (about its centre):
constexpr const char* ContactForceDeviation = "ContactForceDeviation"; // 3, standard, by noise, N
constexpr const char* ContactCentre = "ContactCentre"; // 3, of pressure, on the surface at rest, m
constexpr const char* ContactCentreDeviation = "ContactCentreDeviation"; // of its place, standard, m
constexpr const char* ContactPeak = "ContactPeak";                       // id of the point
constexpr const char* ContactPeakPressure = "ContactPeakPressure";       // Pa
constexpr const char* ContactArea = "ContactArea";                       // m^2
// Field data of all contacts:
constexpr const char* RecoveredForce = "RecoveredForce";                   // 3, N
constexpr const char* RecoveredForceDeviation = "RecoveredForceDeviation"; // 3, standard, by noise, N
constexpr const char* ObservedPoint = "ObservedPoint"; // 3, on the surface at rest, a tuple a marker, m
constexpr const char* ObservedDisplacement = "ObservedDisplacement"; // 3, m, NaN where not seen
constexpr const char* ObservedResidual = "ObservedResidual";         // 3, less the explained, m
constexpr const char* ObservationNoise = "ObservationNoise";         // standard deviation, m
constexpr const char* ObservationMisfit = "ObservationMisfit"; // over the deviations given, or -1
constexpr const char* LoadPatchRadius = "LoadPatchRadius";     // m; 0 for single vertices
constexpr const char* RecoveredSupportYield = "RecoveredSupportYield"; // 2: m/N, rad/(N m)
constexpr const char* SupportYieldShare = "SupportYieldShare"; // of the observed displacements
constexpr const char* RecoveryWarnings = "RecoveryWarnings";   // strings

// Field data of vtkStiffnessArtifacts: two values each, of single vertices and under the mask.
constexpr const char* ArtifactVariation = "ArtifactVariation"; // of |K| about its smooth part
constexpr const char* ArtifactAreaCorrelation = "ArtifactAreaCorrelation"; // Spearman's, with areas
constexpr const char* ArtifactLargestJump = "ArtifactLargestJump"; // across an edge, relative
constexpr const char* SmoothingLength = "SmoothingLength";         // m
constexpr const char* StiffnessChangeMeasures =
  "StiffnessChangeMeasures"; // median, variation, 95th percentile of its size, vertices compared

// Field data: a table of measurements, the third input of vtkGreensFunctionIdentification and the output
// of vtkRigSimulation. A tuple a displacement:
constexpr const char* MeasurementProbe = "MeasurementProbe";   // int, which probe
constexpr const char* MeasurementVertex = "MeasurementVertex"; // id of the marker, or -1 for that below
constexpr const char* MeasurementPoint = "MeasurementPoint";   // 3, of the marker at rest, m
constexpr const char* MeasuredDisplacement = "MeasuredDisplacement"; // 3, m, NaN where not measured
constexpr const char* MeasurementRow = "MeasurementRow"; // int, of the file's line, for people; optional
constexpr const char* MeasurementDeviation = "MeasurementDeviation"; // 1 or 3, standard, m, optional
// A tuple a probe:
constexpr const char* ProbeNames = "ProbeNames";   // strings, optional
constexpr const char* ProbeVertex = "ProbeVertex"; // id of the contact, or -1 for that below
constexpr const char* ProbePoint = "ProbePoint";   // 3, of the contact at rest, m
constexpr const char* ProbeRadius = "ProbeRadius"; // of the mask of its force, m, optional
constexpr const char* ProbeForce = "ProbeForce";   // 3, on the body, N

// Field data of vtkGreensFunctionIdentification, besides the table in the frame of the surface.
constexpr const char* MeasurementResidual = "MeasurementResidual"; // 3, measured less predicted, m
constexpr const char* MeasurementHeldOutResidual = "MeasurementHeldOutResidual"; // the same, left out
constexpr const char* MeasurementOutlier = "MeasurementOutlier";   // uint8, 1 left out
constexpr const char* ProbeResidual = "ProbeResidual"; // root mean square of a component, m
constexpr const char* ProbeRelativeResidual = "ProbeRelativeResidual"; // over the displacements
constexpr const char* ProbeOutliers = "ProbeOutliers";                 // how many, a tuple a probe
constexpr const char* IdentifiedNames = "IdentifiedNames"; // strings: what was identified
constexpr const char* IdentifiedUnits = "IdentifiedUnits"; // strings
/// Value, standard deviation (at a bound as if that were not there), bounds of the interval of 95 %; a tuple a parameter.
constexpr const char* IdentifiedParameters = "IdentifiedParameters";
constexpr const char* IdentifiedCorrelations = "IdentifiedCorrelations"; // a row a tuple
constexpr const char* YoungsModulusDeviation = "YoungsModulusDeviation"; // standard, Pa
constexpr const char* PoissonRatioDeviation = "PoissonRatioDeviation";   // 0 where it was known
constexpr const char* SupportYieldLength = "SupportYieldLength"; // E / k of an elastic foundation, m
constexpr const char* MeasurementNoise = "MeasurementNoise";     // standard deviation, m
constexpr const char* MeasurementMisfit = "MeasurementMisfit"; // residuals over deviations given, or -1
constexpr const char* HoldOutError = "HoldOutError"; // of probes left out, relative, or -1
constexpr const char* FitError = "FitError"; // the same of what was fitted: residuals over displacements
/// Of residuals of neighbouring markers under one probe: their correlation, and how probable noise has as much.
constexpr const char* NeighbourCorrelation = "NeighbourCorrelation";
/// By how much the mesh makes parameters too large, of several regions; a tuple a parameter.
constexpr const char* ParametersOffByMesh = "ParametersOffByMesh";
/// Standard, of parameters, by what leaving out each probe changes; -1 for too few; a tuple a parameter.
constexpr const char* ProbewiseDeviation = "ProbewiseDeviation";
constexpr const char* ResponseInterpolationError = "ResponseInterpolationError"; // relative
constexpr const char* RegistrationRotation = "RegistrationRotation"; // 9, row by row
constexpr const char* RegistrationTranslation = "RegistrationTranslation"; // 3, m
constexpr const char* RegistrationDeviation = "RegistrationDeviation"; // 6: about x, y, z (rad), along (m)
/// Share of the parameters' standard deviations that the registration has; a tuple a parameter.
constexpr const char* ParameterDeviationByRegistration = "ParameterDeviationByRegistration";
constexpr const char* RegistrationDistance = "RegistrationDistance"; // places from the surface, m
constexpr const char* PriorHoldOutError = "PriorHoldOutError"; // of vtkComplianceCorrection: its prior's
constexpr const char* CorrectionSmoothing = "CorrectionSmoothing"; // noise over correction, variances
constexpr const char* DeterminedUnknowns = "DeterminedUnknowns"; // of a field's: by measurements
// Of vtkIdentificationByCrossValidation: kinds of models and their errors under probes left out, NaN for none.
constexpr const char* TriedModels = "TriedModels";
constexpr const char* TriedHoldOutErrors = "TriedHoldOutErrors";
constexpr const char* FieldDeviation = "FieldDeviation"; // that was expected of a field's ln E
constexpr const char* UniformFitError = "UniformFitError"; // FitError of one modulus in place of a field
// A tuple a probe that was proposed: its vertex, its force, and the standard deviations that the
// parameters would have with all up to it.
constexpr const char* NextProbeVertex = "NextProbeVertex";         // id
constexpr const char* NextProbeForce = "NextProbeForce";           // 3, on the body, N
constexpr const char* NextProbeDeviations = "NextProbeDeviations"; // in the parameters' order and units

// Cell data of a volume mesh of several materials, of vtkGreensFunctionIdentification.
constexpr const char* MaterialRegion = "MaterialRegion"; // int from 0

// Cell data of the volume that vtkStiffnessFieldIdentification gives, besides YoungsModulus and PoissonRatio.
constexpr const char* LogModulusDeviation = "LogModulusDeviation"; // standard, of ln E

// Field data: the surface that this one was remeshed from (vtkIsotropicRemeshing, vtkOriginalSurface).
constexpr const char* OriginalPoints = "OriginalPoints";       // 3, m
constexpr const char* OriginalTriangles = "OriginalTriangles"; // 3, id: of these points
/// Where each of these points is on this surface: the triangle, and the weights of its corners.
constexpr const char* OriginalPointTriangle = "OriginalPointTriangle"; // id
constexpr const char* OriginalPointWeights = "OriginalPointWeights";   // 3
constexpr const char* OriginalDistance = "OriginalDistance"; // largest of a point from its place, m
constexpr const char* OriginalVolumeChange = "OriginalVolumeChange"; // this one's over its, - 1
constexpr const char* OriginalFingerprint = "OriginalFingerprint"; // uint64, of this surface

// Constraints, the second input of vtkCapacitanceSolve (a tuple a constraint).
constexpr const char* Node = "Node";           // id
constexpr const char* Direction = "Direction"; // 3, optional: only this component
// SpringStiffness (1, N/m, optional): a spring to the displacement
constexpr const char* Zone = "Zone";           // int, optional: whose force it counts to

/// Field data of one computation of Green's functions.
constexpr const char* GreensFunctionResults[] = { GreensFunctions, GreensFunctionNodes,
  PatchGreensFunctions, PatchGreensFunctionNodes, WeightResponse, Density,
  ProbeGreensFunctions, ProbePoints, ProbeStiffness, SurfaceElasticity, GreensFunctionYoungsModulus, GreensFunctionSource,
  HomogeneousMaterial, GreensFunctionDomain, Clamped, GreensFunctionsReciprocal, MeshFingerprint, ConditionEstimate,
  ReciprocityDefect, RotationDefect, SolverResidual, IntegrationTolerance, WallRatio, SupportWidth,
  RockingCompliance, ErrorEstimate, ContactErrorEstimate, MostErrorEstimate, DiscretizationError,
  IntegrationError, SolverError, StorageError, ErrorLoadLength, ToleranceSteps, PeakBytes, StageSeconds,
  StageNames, Warnings, MeasurementResidual, MeasurementHeldOutResidual, MeasurementOutlier, ProbeResidual, ProbeRelativeResidual,
  ProbeOutliers, IdentifiedNames, IdentifiedUnits, IdentifiedParameters, IdentifiedCorrelations,
  YoungsModulusDeviation, PoissonRatioDeviation, SupportYieldLength, MeasurementNoise, MeasurementMisfit,
  HoldOutError, FitError, TriedModels, TriedHoldOutErrors, FieldDeviation, UniformFitError, ResponseInterpolationError, RegistrationRotation, RegistrationTranslation,
  NeighbourCorrelation, ProbewiseDeviation, ParametersOffByMesh, ParameterDeviationByRegistration,
  RegistrationDeviation, RegistrationDistance, DeterminedUnknowns, PriorHoldOutError, CorrectionSmoothing,
  NextProbeVertex, NextProbeForce, NextProbeDeviations };
/// Field data of the surface that one was remeshed from.
constexpr const char* OriginalSurface[] = { OriginalPoints, OriginalTriangles, OriginalPointTriangle,
  OriginalPointWeights, OriginalDistance, OriginalVolumeChange, OriginalFingerprint };
/// Field data of one table of measurements.
constexpr const char* MeasurementTable[] = { MeasurementProbe, MeasurementRow, MeasurementVertex,
  MeasurementPoint, MeasuredDisplacement, MeasurementDeviation, ProbeNames, ProbeVertex, ProbePoint,
  ProbeRadius, ProbeForce };
/// Point and field data of one contact.
constexpr const char* ContactResults[] = { Displacement, Traction, ContactForce, ContactTorque,
  ContactRotation, ContactCondition, LargestDisplacementGradient, ContactPoint, ElasticContactPoint,
  HapticContactPoint, ContactPressure, ContactPressureDeviation, ContactNumber, ContactForceDeviation,
  ContactCentre, ContactCentreDeviation, ContactPeak, ContactPeakPressure, ContactArea, RecoveredForce,
  RecoveredForceDeviation, ObservedPoint, ObservedDisplacement, ObservedResidual, ObservationNoise,
  ObservationMisfit, LoadPatchRadius, RecoveredSupportYield, SupportYieldShare, RecoveryWarnings };
/// Cell data of one contact.
constexpr const char* ContactCellResults[] = { Strain, Stress, VonMisesStress, PrincipalStress };
/// Point data of all contacts with one model, and field data of one mask.
constexpr const char* StiffnessResults[] = { PressureMask, TorqueMask, Stiffness, StiffnessNorm,
  StiffnessAsymmetry, StiffnessLimited, RotationalStiffness, MaskSupportShare, MaskBeyondShare,
  HapticRatio, HapticStiffness, SingleVertexStiffnessNorm, StiffnessCondition, PrincipalStiffness1,
  PrincipalStiffness2, PrincipalStiffness3, SmoothStiffnessNorm, StiffnessArtifact, SingleVertexArtifact,
  StiffnessJump, StiffnessChange, ArtifactVariation, ArtifactAreaCorrelation, ArtifactLargestJump,
  SmoothingLength, StiffnessChangeMeasures };
} // namespace palpate::arrays

#endif
