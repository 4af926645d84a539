// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/drawing_memory.hpp"

#include <vtkFreeTypeTools.h>
#include <vtkNew.h>
#include <vtkTextProperty.h>

#include <atomic>

namespace breast {

namespace {

std::atomic<bool> was_refused = false;
FT_Memory fonts = nullptr;  // of VTK's FreeType library, of which there is one
FT_MemoryRec_ original;

void* noted(void* block) {
  if (block == nullptr) was_refused = true;
  return block;
}
void* allocate(FT_Memory memory, long size) {
  return noted(original.alloc(memory, size));
}
void* reallocate(FT_Memory memory, long size, long new_size, void* block) {
  return noted(original.realloc(memory, size, new_size, block));
}

void note_and_throw() {
  was_refused = true;
  throw std::bad_alloc();
}

// Every typeface names the memory of its library; the library itself does not.
FT_Memory font_memory() {
  vtkNew<vtkTextProperty> property;
  FT_Face face = nullptr;
  if (!vtkFreeTypeTools::LookupFace(property, *vtkFreeTypeTools::GetInstance()->GetLibrary(),
                                    &face))
    throw std::bad_alloc();
  const FT_Memory memory = face->memory;
  FT_Done_Face(face);
  return memory;
}

}  // namespace

DrawingMemory::DrawingMemory() {
  fonts = font_memory();
  original = *fonts;
  was_refused = false;
  fonts->alloc = allocate;
  fonts->realloc = reallocate;
  before_ = std::set_new_handler(note_and_throw);
}

DrawingMemory::~DrawingMemory() {
  std::set_new_handler(before_);
  fonts->alloc = original.alloc;
  fonts->realloc = original.realloc;
}

bool DrawingMemory::refused() const {
  return was_refused;
}

}  // namespace breast
