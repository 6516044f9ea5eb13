#pragma once
#include <string>

namespace espalier::bench {

/// The machine and what was built with what, for whoever reads a figure later.
std::string machineText();

/// How busy the machine was when the run began.
std::string loadText();

/// Bytes read and written a second by copying arrays that no cache holds, on all threads: the median of five.
double copyBandwidth();

}  // namespace espalier::bench
