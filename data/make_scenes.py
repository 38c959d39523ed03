#!/usr/bin/env python3
# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Make what the scenes of scenes/ name, next to them: two models and the recording of a hand that closes."""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
BUILT = HERE.parent / "build" / "bin" / "palpate"
MODELS = ("kidney", "nodule")
REFINEMENTS = 2  # from level 1 to 3

RATE = 1000  # moments a second
ABOVE, CLOSING, HOLDING = 1.0, 1.5, 1.5  # seconds
AWAY = 0.06  # m, from where the hand begins to where it closes
PROXIMAL, MIDDLE, DISTAL = 0.05, 0.12, 0.2  # rad, of a finger at the end: its tip presses
FINGERS = (4, 7, 11, 15)  # proximal joints of index, middle, ring and little finger (hand_model.h)
THUMB_ABDUCTION, JOINTS = 3, 22


def smooth(fraction):
    """From 0 to 1, with neither end abrupt."""
    t = min(max(fraction, 0), 1)
    return t * t * (3 - 2 * t)


def joint_angles(closed):
    angles = [0.0] * JOINTS
    for proximal in FINGERS:
        angles[proximal:proximal + 3] = (x * closed for x in (PROXIMAL, MIDDLE, DISTAL))
    angles[THUMB_ABDUCTION] = 0.8
    return angles


def closing_hand():
    """A recording as `palpate touch --record` writes it: a hand comes sideways, and its fingers close."""
    moments = []
    for i in range(round((ABOVE + CLOSING + HOLDING) * RATE)):
        time = (i + 1) / RATE
        y = AWAY * (1 - smooth(time / ABOVE))
        angles = " ".join(f"{x:.6g}" for x in joint_angles(smooth((time - ABOVE) / CLOSING)))
        moments.append(f"{i + 1} 0 {y:.6g} 0 1 0 0 0 0 {JOINTS} {angles}")
    head = ["palpate-device-recording 1", "name a hand that closes", "limits 10 1 0",
            f"moments {len(moments)}"]
    return "\n".join(head + moments) + "\n"


def make_model(program, name, folder):
    with tempfile.TemporaryDirectory() as aside:
        fine = Path(aside) / f"{name}.vtp"
        for command in (("refine", HERE / f"{name}.vtp", fine, "--levels", REFINEMENTS),
                        ("precompute", fine, folder / f"{name}.vtp")):
            subprocess.run([program, *map(str, command)], check=True, stdout=subprocess.DEVNULL)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", default=BUILT if BUILT.exists() else shutil.which("palpate"),
                        help="palpate; by default that of build/, else that of the PATH")
    parser.add_argument("--folder", type=Path, default=HERE / "scenes", help="by default scenes/")
    options = parser.parse_args()
    if not options.program:
        sys.exit("make_scenes: there is no palpate: build it, or give --program")
    try:
        for name in MODELS:
            make_model(options.program, name, options.folder)
        (options.folder / "closing_hand.txt").write_text(closing_hand())
    except (OSError, subprocess.CalledProcessError) as failure:
        sys.exit(f"make_scenes: {failure}")


if __name__ == "__main__":
    main()
