# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Every public function has an example in its docstring, and every example runs."""

import doctest
import inspect
import unittest

import palpate
from palpate import arrays, errors, files, functions


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
        for module in (palpate, arrays, errors, files, functions):
            failed, attempted = doctest.testmod(module)
            self.assertEqual(failed, 0, module.__name__)
            examples += attempted
        self.assertGreater(examples, 20)


if __name__ == "__main__":
    unittest.main()
