# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""`palpate devices`, with devices that umockdev shows to it."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["PALPATE_PROGRAM"]

DESCRIPTION = """{"name": "slider", "vendor": "0x1209", "product": "0x0002",
  "input": {"report": 0, "length": 2,
            "position": [{"offset": 0, "type": "int16", "scale": 1e-5}, null, null]}}"""


def record(number, vendor, product, name, descriptor):
    """A USB HID device in umockdev's format."""
    usb = f"/devices/{number + 1}-1"
    interface = f"{usb}/{number + 1}-1:1.0"
    ids = f"0003:{vendor:08X}:{product:08X}"
    hid = f"{interface}/{ids}.{number}"
    return (f"P: {usb}\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\nA: manufacturer=Emulated\n"
            f"A: product={name}\nA: idVendor={vendor:04x}\nA: idProduct={product:04x}\n"
            f"A: bcdDevice=0100\nA: serial=S{number}\n\n"
            f"P: {interface}\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\n"
            f"A: bInterfaceNumber=00\n\n"
            f"P: {hid}\nE: SUBSYSTEM=hid\nE: HID_ID={ids}\nE: HID_NAME={name}\n"
            f"E: HID_UNIQ=S{number}\nH: report_descriptor={descriptor}\n\n"
            f"P: {hid}/hidraw/hidraw{number}\nN: hidraw{number}\nE: DEVNAME=/dev/hidraw{number}\n"
            f"E: SUBSYSTEM=hidraw\nL: device=../../../{ids}.{number}\n\n")


SIX_AXES = "05010908A1018501093009310932093309340935" "16A2FE265E01751095068102C0"
OWN_REPORTS = ("0650FF0901A101150026FF007508953F"
               "850109028102" "850209039102" "85030904B102" "C0")
VENDORS = "0600FF0901A10109021500257F750895028102C0"


class Devices(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_with(self, records, *arguments, status=0):
        """What `palpate devices` prints on a machine with these devices; its error if it fails."""
        if not shutil.which("umockdev-run"):
            self.skipTest("umockdev-run is not installed")
        machine = self.folder / "machine.umockdev"
        machine.write_text("".join(records))
        devices = ["--device", machine] if records else []
        ran = subprocess.run(["umockdev-run", *devices, "--", PROGRAM, "devices", *arguments],
                             capture_output=True, text=True)
        self.assertEqual(ran.returncode, status, ran.stderr)
        return ran.stderr if status else ran.stdout

    def test_without_any_it_says_so(self):
        self.assertIn("HID devices                 none is plugged in\n", self.run_with([]))

    def test_tells_what_each_can_do(self):
        told = self.run_with([
            record(0, 0x256F, 0xC635, "SpaceMouse Compact", SIX_AXES),
            record(1, 0x1209, 0x0001, "Open arm", OWN_REPORTS),
            record(2, 0x1209, 0x0002, "Slider", VENDORS)])
        lines = {line.split()[0]: line for line in told.splitlines()}
        self.assertIn("256f:c635  SpaceMouse Compact (S0)  SpaceMouse: six axes in",
                      lines["/dev/hidraw0"])
        self.assertIn("1209:0001  Open arm (S1)  Palpate's reports: pose in", lines["/dev/hidraw1"])
        self.assertIn("not known: --description FILE", lines["/dev/hidraw2"])
        for built_in in ("mouse", "simulated", "recording", "glove"):
            self.assertIn("built in", lines[built_in])

    def test_checks_descriptions(self):
        board = self.folder / "board.json"
        board.write_text(DESCRIPTION)
        slider = record(0, 0x1209, 0x0002, "Slider", VENDORS)
        told = self.run_with([slider], "--description", board)
        self.assertIn("plugged in                  yes, /dev/hidraw0", told)
        self.assertIn("plugged in                  no",
                      self.run_with([], "--description", board))
        board.write_text(DESCRIPTION.replace("int16", "int17"))
        error = self.run_with([slider], "--description", board, status=1)
        self.assertTrue(error.startswith("palpate: ") and error.count("\n") == 1, error)
        self.assertIn('"input.position[0].type" must be one of', error)

    def test_has_an_example_in_its_help_that_is_one(self):
        told = subprocess.run([PROGRAM, "devices", "--help"], capture_output=True, text=True).stdout
        self.assertIn("  palpate devices ", told)
        board = self.folder / "board.json"
        board.write_text(told[told.index("{"):told.rindex("}") + 1])
        self.assertIn("description of              paddle", self.run_with([], "--description", board))

    def test_alone_loads_hidapi(self):
        def loads_hidapi(*arguments):
            ran = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True,
                                 env={**os.environ, "LD_DEBUG": "files"})
            return "libhidapi" in ran.stderr

        self.assertTrue(loads_hidapi("devices"))
        self.assertFalse(loads_hidapi("info", self.folder / "no.vtp"))
        self.assertFalse(loads_hidapi("--version"))


if __name__ == "__main__":
    unittest.main()
