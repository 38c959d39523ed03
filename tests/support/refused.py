# SPDX-FileCopyrightText: Palpate contributors
# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls that are refused in a sentence."""

import unittest

import palpate
from support.surfaces import lower_cap


class Refusals(unittest.TestCase):
    def refused(self, sentence, call, *arguments, **options):
        """The call raises palpate.Error with a sentence of one line that holds `sentence`."""
        with self.assertRaises(palpate.Error) as caught:
            call(*arguments, **options)
        said = str(caught.exception)
        self.assertIn(sentence, said)
        self.assertNotIn("\n", said.strip())

    def precompute_refused(self, sentence, surface, **options):
        options = {"young": 1e4, "poisson": 0.3, "fixed": lower_cap(surface), **options}
        self.refused(sentence, palpate.precompute, surface, **options)
