// Folders of temporary results, so that a program that ends without unwinding can still remove them.
#pragma once

namespace breast {

/// From now on remove_leftovers() removes this folder. A few at a time; beyond that, or where the path is very long, it
/// does nothing.
void note_leftover(const char* folder) noexcept;
void forget_leftover(const char* folder) noexcept;

/// Removes the noted folders of this process (not those of the process it was forked from) with all that is in them.
/// Neither allocates nor locks: it may be called in a signal handler.
void remove_leftovers() noexcept;

}  // namespace breast
