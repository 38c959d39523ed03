// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef palpate_mark_colours_h
#define palpate_mark_colours_h

namespace palpate
{
constexpr double ToolColour[3] = { 0.25, 0.6, 0.3 };
constexpr double StaticColour[3] = { 0.1, 0.3, 0.85 };     ///< x^C of [JP01] fig. 8
constexpr double GodObjectColour[3] = { 0.95, 0.7, 0.05 }; ///< x^E
constexpr double ProbeColour[3] = { 0.05, 0.45, 0.15 };    ///< x^H
constexpr double ForceColour[3] = { 0.8, 0.1, 0.1 };
} // namespace palpate

#endif
