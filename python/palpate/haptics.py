# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Touch a model in a render window, or without one on virtual time.

Importing this module loads VTK's rendering; `import palpate` alone does not.

>>> import palpate, palpate.haptics
>>> kidney = palpate.refine(palpate.read(palpate.example("kidney")), levels=2)
>>> model = palpate.precompute(kidney, young=8e3, poisson=0.45)
>>> style = palpate.haptics.vtkInteractorStyleHaptic()
>>> style.SetModel(model)
True
>>> style.MoveProbe(0, 0, 0.04) and style.RunHeadless(2)
True
>>> style.IsTouching()
False
>>> style.MoveProbe(0, 0, 0.012) and style.RunHeadless(1)
True
>>> force = [0.0, 0.0, 0.0]
>>> style.GetForce(0, force)
>>> style.IsTouching() and force[2] > 0
True
"""

from vtkmodules import vtkInteractionStyle  # noqa: F401
from vtkmodules import vtkRenderingFreeType  # noqa: F401
from vtkmodules import vtkRenderingOpenGL2  # noqa: F401

from .PalpateHaptics import *  # noqa: F401,F403
