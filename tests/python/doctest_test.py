# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public function has an example in its docstring, and every example runs."""

import doctest
import inspect
import subprocess
import sys
import unittest

import palpate
import palpate.haptics
from palpate import (arrays, contacts, errors, fields, files, imports, precomputation,
                     surfaces)


class Docstrings(unittest.TestCase):
    def test_every_public_function_has_a_runnable_example(self):
        for name in palpate.__all__:
            value = getattr(palpate, name)
            if inspect.isfunction(value):
                self.assertIn(">>> ", value.__doc__ or "", name)
                sections = ("Parameters", "Returns", "Raises")
                for section in sections if name != "write" else ("Parameters", "Raises"):
                    self.assertIn(section, value.__doc__, name)

    def test_every_example_runs(self):
        examples = 0
        for module in (palpate, arrays, contacts, errors, fields, files, imports, precomputation,
                       surfaces, palpate.haptics):
            failed, attempted = doctest.testmod(module)
            self.assertEqual(failed, 0, module.__name__)
            examples += attempted
        self.assertGreater(examples, 20)
        self.assertGreater(doctest.testmod(palpate.haptics).attempted, 5)


class Imports(unittest.TestCase):
    def loaded_by(self, statement):
        """Names of Python's modules and of libraries that a fresh interpreter has after it."""
        script = (f"{statement}; import sys; print(*sys.modules); "
                  "print(*{line.split('/')[-1] for line in open('/proc/self/maps')})")
        return subprocess.run([sys.executable, "-c", script], check=True, capture_output=True,
                              text=True).stdout

    def test_of_the_package_alone_load_nothing_that_draws_and_no_devices(self):
        alone, touching = self.loaded_by("import palpate"), self.loaded_by("import palpate.haptics")
        # VTK's readers need vtkRenderingCore, which draws nothing by itself.
        for name in ("vtkmodules.vtkRendering", "vtkRenderingOpenGL", "vtkInteraction", "libGL",
                     "libX11", "hidapi", "PalpateHaptics"):
            self.assertFalse(name in alone, name)
        for name in ("vtkmodules.vtkRenderingOpenGL2", "vtkInteractionStyle", "libPalpateHaptics"):
            self.assertTrue(name in touching, name)


if __name__ == "__main__":
    unittest.main()
