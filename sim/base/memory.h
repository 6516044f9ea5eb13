#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace espalier::sim {

/// Bytes that a job may plan to use: three quarters of the least of the machine's memory that others leave to
/// it, the limits of this process's control group (Linux) and RLIMIT_AS. The rest is for the system, libraries
/// and the stack. Found once.
double memoryBudget();

/// Bytes that this process uses now: the address space, where RLIMIT_AS is the least of those limits, or else
/// what is resident. 0 where /proc/self/statm cannot be read.
double memoryInUse();

/// Bytes that the machine can still give without taking them from anybody, by the text of /proc/meminfo;
/// infinity where it does not say so.
double availableIn(std::string_view meminfo);

/// The least limit on memory, in bytes, of a control group and those around it; infinity where there is none.
/// `about` is what /proc/self/cgroup says, `root` where control groups are mounted (version 2, or 1 with its
/// `memory` folder).
double controlGroupLimit(std::string_view about, const std::filesystem::path& root);

/// Gives memory that was freed back to the system, as far as the C library lets us: what comes next asks for
/// large blocks, which do not fit into the holes that many small ones left.
void releaseFreed();

/// An amount of memory in words: "1.4 GB" (1024^3 bytes).
std::string inGigabytes(double bytes);

}  // namespace espalier::sim
