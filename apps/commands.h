// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#pragma once

namespace CLI {
class App;
}

/// The subcommands of `palpate`, a source file each. Each adds its options and what runs when it is
/// chosen.
namespace palpate::app {

void addInfo(CLI::App& program);
void addRepair(CLI::App& program);
void addRefine(CLI::App& program);
void addRemesh(CLI::App& program);
void addOriginal(CLI::App& program);
void addPrecompute(CLI::App& program);
void addImport(CLI::App& program);
void addFoundation(CLI::App& program);
void addGravity(CLI::App& program);
void addIdentify(CLI::App& program);
void addMeasure(CLI::App& program);
void addPress(CLI::App& program);
void addRecover(CLI::App& program);
void addCorrect(CLI::App& program);
void addStiffness(CLI::App& program);
void addArtifacts(CLI::App& program);
void addAccuracy(CLI::App& program);
void addTouch(CLI::App& program);
void addGrasp(CLI::App& program);
void addDevices(CLI::App& program);

}  // namespace palpate::app
