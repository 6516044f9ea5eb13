#include "rules/language/emission_keys.h"

#include "rules/language/emission.h"
#include "rules/language/key_builder.h"

namespace espalier::rules {

std::shared_ptr<const Table> emissionKeys() {
  return TableOf<Emission>()
      .colour("colour", &Emission::colour, {.meaning = "Of the light."})
      .number("strength", &Emission::strength,
              {.unit = "factor",
               .limits = {0.0, 1000.0},
               .meaning = "How bright: 1 is white paper in full light."})
      .shared();
}

}  // namespace espalier::rules
