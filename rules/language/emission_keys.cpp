#include "rules/language/emission_keys.h"

#include "rules/language/emission.h"
#include "rules/language/key_builder.h"

namespace espalier::rules {
namespace {

template <class T>
TableOf<T> keysOf() {
  TableOf<T> table;
  table.colour("colour", &T::colour, {.meaning = "Of the light."})
      .number("strength", &T::strength,
              {.unit = "factor",
               .limits = {0.0, 1000.0},
               .meaning = "How bright: 1 is white paper in full light."});
  return table;
}

}  // namespace

std::shared_ptr<const Table> emissionKeys() {
  return keysOf<Emission>().shared();
}

std::shared_ptr<const Table> stemEmissionKeys() {
  return keysOf<StemEmission>()
      .number("order_share", &StemEmission::order_share,
              {.unit = "factor",
               .limits = {0.0, 1.0},
               .meaning = "What of it is left with each order of branching: limbs are the fainter, the more "
                          "often they fork."})
      .shared();
}

}  // namespace espalier::rules
