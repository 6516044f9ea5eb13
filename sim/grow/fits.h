#pragma once
#include <cstddef>
#include <string>

#include "sim/base/memory.h"

namespace espalier::sim {

/// The memory that growth has, and what comes after it needs.
struct MemoryPlan {
  double budget_bytes = memoryBudget();  ///< of the whole process
  double later_bytes = 0.0;              ///< for what comes after growth, whatever has grown
  double later_a_segment = 0.0;          ///< and for each segment: its model, its files
  double later_an_element = 0.0;         ///< likewise
};

/// Judges before each iteration whether it fits, by what earlier ones of this run took.
class Fits {
 public:
  /// Growth begins, or goes on.
  explicit Fits(const MemoryPlan& plan);

  struct Grown {
    int iterations = 0;
    std::size_t segments = 0, elements = 0;
  };
  /// Why an iteration in which at most so many sites grow would not fit, in a sentence; empty where it does.
  std::string whyNot(const Grown& so_far, std::size_t sites) const;
  /// An iteration is done in which so many sites were asked.
  void asked(std::size_t sites) { asked_ += sites; }

 private:
  MemoryPlan plan_;
  double before_bytes_;  // in use before anything grew
  std::size_t asked_ = 0;
};

}  // namespace espalier::sim
