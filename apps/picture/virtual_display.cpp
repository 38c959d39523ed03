// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "picture/virtual_display.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <X11/Xlib.h>

#include <cerrno>
#include <cstdlib>
#include <iostream>
#include <stdexcept>
#include <string>
#include <utility>

namespace palpate::app {
namespace {

constexpr int kStartMilliseconds = 20000;

std::function<void()> lossAction;  // Xlib's handler takes no data

/// A process group of its own: Ctrl-C is the program's, which still needs the server to end well.
[[noreturn]] void becomeServer(int displayNumberPipe) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const std::string pipeText = std::to_string(displayNumberPipe);
  if (!freopen("/dev/null", "w", stderr)) _exit(127);
  execlp("Xvfb", "Xvfb", "-displayfd", pipeText.c_str(), "-screen", "0", "1280x1024x24",
         "-nolisten", "tcp", "-noreset", static_cast<char*>(nullptr));
  _exit(127);
}

/// The line that the server writes when it is ready; empty if it ends or takes too long.
std::string readLine(int pipe) {
  std::string line;
  for (char c;;) {
    pollfd waiting{pipe, POLLIN, 0};
    const int ready = poll(&waiting, 1, kStartMilliseconds);
    if (ready < 0 && errno == EINTR) continue;  // whoever asks for the display ends the program
    if (ready <= 0 || read(pipe, &c, 1) != 1) return {};
    if (c == '\n') return line;
    line += c;
  }
}

void stop(int process) {
  kill(process, SIGTERM);
  waitpid(process, nullptr, 0);
}

}  // namespace

bool hasDisplay() {
  Display* display = XOpenDisplay(nullptr);
  if (display) XCloseDisplay(display);
  return display != nullptr;
}

VirtualDisplay::VirtualDisplay() {
  if (hasDisplay()) return;
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("a picture cannot be drawn: no pipe to be had");
  server_ = fork();
  if (server_ == 0) {
    close(ends[0]);
    becomeServer(ends[1]);
  }
  close(ends[1]);
  const std::string number = server_ > 0 ? readLine(ends[0]) : std::string();
  close(ends[0]);
  if (number.empty()) {
    if (server_ > 0) stop(server_);
    server_ = -1;
    throw std::runtime_error(
        "a picture needs a display or the program Xvfb (Debian's package xvfb), and there is "
        "neither");
  }
  setenv("DISPLAY", (":" + number).c_str(), 1);
}

OnDisplayLoss::OnDisplayLoss(std::function<void()> action) {
  lossAction = std::move(action);
  XSetIOErrorHandler([](Display*) -> int {
    if (lossAction) lossAction();
    std::cerr << "palpate: the display is gone\n";
    std::_Exit(1);
  });
}

OnDisplayLoss::~OnDisplayLoss() {
  lossAction = nullptr;
}

VirtualDisplay::~VirtualDisplay() {
  if (server_ > 0) stop(server_);
}

}  // namespace palpate::app
