# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the program's commands must do with any sound model."""

from support.surfaces import run


def require_all_commands(test, model, out, *, made_by, radius, tool_radius):
    """That a flat sheet of one piece can be looked at, pressed in the middle, and touched."""
    info = run("info", model).stdout
    test.assertRegex(info, "pieces +1")
    test.assertRegex(info, "sound +yes")
    test.assertIn(made_by, info)
    pressed = run("press", model, out, "--at", 0, 0, 0, "--displacement", 0, 0, -0.003, "--radius", radius)
    test.assertEqual(pressed.returncode, 0, pressed.stderr)
    stiffness = run("stiffness", model, out, "--radius-edges", 2)
    test.assertEqual(stiffness.returncode, 0, stiffness.stderr)
    for tool in ((), ("--tool-radius", tool_radius)):
        touched = run("touch", model, *tool, "--device", "simulated", "--headless", "--seconds", 1)
        test.assertEqual(touched.returncode, 0, touched.stderr)
