#pragma once
#include <memory>

#include "rules/language/key.h"

namespace espalier::rules {

/// The keys of Diffusion.
std::shared_ptr<const Table> diffusionKeys();

/// Complains of what no diffusion could follow.
void checkDiffusion(const RuleSet& rules, const Check::Given& given, const Check::Complain& complain);

}  // namespace espalier::rules
