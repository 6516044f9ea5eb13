#pragma once
#include <functional>
#include <memory>
#include <string>

#include "rules/language/envelope_spec.h"
#include "rules/language/key.h"
#include "rules/language/key_builder.h"

/// The keys of solids and of points in them, for the tables of scenes and of rules.
namespace espalier::rules {

/// Complains of a solid that is none, such as one whose profile falls. `path` is of the mapping that holds
/// it. That exactly one is stated is the caller's to see to: it knows what else could stand there.
void checkEnvelope(const EnvelopeSpec& spec, const std::string& path, const Check::Complain& complain);
/// Complains of a density that is none.
void checkStrewing(const StrewingSpec& spec, const std::string& path, const Check::Complain& complain);
/// Complains of a crown without a solid, with two, and as those do.
void checkCrown(const CrownSpec& spec, const std::string& path, const Check::Complain& complain);

/// The keys of a CrownSpec.
std::shared_ptr<const Table> crownKeys();

namespace detail {

std::shared_ptr<const Table> coneKeys();
std::shared_ptr<const Table> domeKeys();
std::shared_ptr<const Table> cylinderKeys();
std::shared_ptr<const Table> sphereKeys();
std::shared_ptr<const Table> ellipsoidKeys();
std::shared_ptr<const Table> boxKeys();
std::shared_ptr<const Table> revolutionKeys();

}  // namespace detail

/// Adds a key for each solid of the EnvelopeSpec that `access` leads to.
template <class T, class A>
void addSolids(TableOf<T>& table, A access) {
  const auto at = [access](auto member) {
    return [=](auto& t) -> auto& {
      return std::invoke(access, t).*member;
    };
  };
  using E = EnvelopeSpec;
  table.section("cone", at(&E::cone), detail::coneKeys(), {.meaning = "A cone, its point up."})
      .section("dome", at(&E::dome), detail::domeKeys(),
               {.meaning = "A round crown as high as its radius, by the Bezier radii R, R, R/2, R/6."},
               "radius")
      .section("cylinder", at(&E::cylinder), detail::cylinderKeys(), {.meaning = "An upright cylinder."})
      .section("sphere", at(&E::sphere), detail::sphereKeys(), {.meaning = "A ball that stands on its foot."},
               "radius")
      .section("ellipsoid", at(&E::ellipsoid), detail::ellipsoidKeys(),
               {.meaning = "An ellipsoid along the axes."}, "radii")
      .section("box", at(&E::box), detail::boxKeys(), {.meaning = "A box along the axes."}, "size")
      .section("revolution", at(&E::revolution), detail::revolutionKeys(),
               {.meaning = "A surface of revolution about the upright axis."}, "profile");
}

/// Adds the keys of the StrewingSpec that `access` leads to.
template <class T, class A>
void addStrewing(TableOf<T>& table, A access) {
  const auto at = [access](auto member) {
    return [=](auto& t) -> auto& {
      return std::invoke(access, t).*member;
    };
  };
  using S = StrewingSpec;
  table
      .whole(
          "count", at(&S::count),
          {.unit = "points", .limits = {1.0, kMostPoints}, .meaning = "How many; 500 where nothing is said."})
      .template choice<sim::Spread>("spread", at(&S::spread),
                                    {{"volume", sim::Spread::volume}, {"height", sim::Spread::height}},
                                    {.meaning = "Even by volume, or as many in each layer of a solid."})
      .pairs("density", at(&S::density),
             {.limits = {0.0, 1e6},
              .meaning = "Density along a solid's height: [share of the height, density], straight between.",
              .most = 256});
}

}  // namespace espalier::rules
