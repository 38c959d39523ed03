// SPDX-FileCopyrightText: Palpate contributors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "picture/png.h"

#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace palpate::app {

void writePng(vtkRenderWindow* window, const std::string& path) {
  vtkNew<vtkWindowToImageFilter> image;
  image->SetInput(window);
  image->SetInputBufferTypeToRGB();
  image->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;  // to memory: libpng prints what goes wrong with files
  writer->WriteToMemoryOn();
  writer->SetInputConnection(image->GetOutputPort());
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  const std::string partial = path + ".part";
  std::ofstream file(partial, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes->GetPointer(0)), bytes->GetNumberOfValues());
  file.close();
  if (!file || std::rename(partial.c_str(), path.c_str()) != 0) {
    std::remove(partial.c_str());
    throw std::runtime_error(path +
                             ": the picture cannot be written: is the folder there and "
                             "writable, is the disk full?");
  }
}

}  // namespace palpate::app
