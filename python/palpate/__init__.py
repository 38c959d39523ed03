# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Touch elastic surfaces: Green's functions, contact forces, deformations and stiffness.

Surfaces are `vtkPolyData` (of VTK or PyVista); results are ordinary VTK arrays on them, which
`array(data, name)` shows as NumPy. The classes of the C++ filters (`vtkBoundaryElementGreensFunctions`
and so on) are here too, for pipelines.

>>> import palpate
>>> kidney = palpate.refine(palpate.read(palpate.example("kidney")), levels=2)
>>> model = palpate.precompute(kidney, young=8e3, poisson=0.45)
>>> pressed = palpate.press(model, point=(0, 0, 0.03), displacement=(0, 0, -0.005), radius=0.015)
>>> bool(palpate.array(pressed, "ContactForce")[0, 2] < 0)
True
"""

from .PalpateElastostatics import *  # noqa: F401,F403
from .PalpateIO import *  # noqa: F401,F403
from .arrays import array, greens_function_nodes, greens_functions
from .contacts import press, solve, stiffness, stiffness_artifacts
from .correction import correct
from .errors import Aborted, Error, ModelWarning
from .fields import probe, surface_stress
from .files import example, read, read_volume, write
from .identification import identify, identify_best, identify_field
from .imports import import_compliance, import_stiffness
from .loads import foundation, gravity
from .measurement_tables import displacement_table, measurement_table, simulate_measurements
from .precomputation import precompute
from .recovery import recover_contacts
from .surfaces import on_original, refine, remesh, repair
from .version import __version__

__all__ = [
    "Aborted",
    "Error",
    "ModelWarning",
    "__version__",
    "array",
    "correct",
    "displacement_table",
    "example",
    "foundation",
    "gravity",
    "greens_function_nodes",
    "greens_functions",
    "identify",
    "identify_best",
    "identify_field",
    "import_compliance",
    "import_stiffness",
    "measurement_table",
    "on_original",
    "precompute",
    "press",
    "probe",
    "read",
    "read_volume",
    "recover_contacts",
    "refine",
    "remesh",
    "repair",
    "simulate_measurements",
    "solve",
    "stiffness",
    "stiffness_artifacts",
    "surface_stress",
    "write",
]
