#pragma once

/// Mesh files are read in a child process. libFuzzer sees nothing of it: neither which lines it reached, nor
/// what a sanitizer said of it, as the program takes a child's crash for a damaged file. These two make both
/// count.
namespace espalier::fuzz {

/// Lets children count in this process's counters, and sanitizers speak to it. Once, before the first child.
void watchChildren();

/// Ends the program where a sanitizer found a fault of ours in a child since it was asked last. A crash
/// inside of Assimp is none: the child is there for it.
void requireChildrenWithoutFault();

}  // namespace espalier::fuzz
