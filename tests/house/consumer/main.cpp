#include <sim/sweep.h>
#include "sim/sky.h"

int main() {
  espalier::sim::BitVolume occupied({32, 32, 32});
  for (int y = 0; y < 32; ++y) occupied.set({16, y, 16});
  const auto field =
      espalier::sim::sweepExposure(occupied, espalier::sim::makeSky({.directions = 64}).directions);
  return field.at({15, 1, 16}) > 0.5f && field.at({15, 1, 16}) < 1.0f ? 0 : 1;
}
