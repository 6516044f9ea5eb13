#include "rules/language/envelope_keys.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/base/counted.h"
#include "sim/base/error.h"

namespace espalier::rules {
namespace {

constexpr Limits kSize{0.0, kMostOfEnvelope_m, true};
const char* const kMetres = "metres";

About size(std::string meaning) {
  return {.unit = kMetres, .limits = kSize, .meaning = std::move(meaning), .required = true};
}

sim::Revolution revolutionOf(const ProfileSpec& spec) {
  sim::Revolution revolution;
  for (std::size_t i = 0; i < revolution.profile.size(); ++i) revolution.profile[i] = spec.profile_m.at(i);
  return revolution;
}

}  // namespace

namespace detail {

std::shared_ptr<const Table> coneKeys() {
  return TableOf<sim::Cone>()
      .metres("height", &sim::Cone::height, size("From its foot to its point."))
      .metres("radius", &sim::Cone::radius, size("At its foot."))
      .shared();
}

std::shared_ptr<const Table> domeKeys() {
  return TableOf<sim::Dome>()
      .metres("radius", &sim::Dome::radius, size("At its foot; its height too."))
      .shared();
}

std::shared_ptr<const Table> cylinderKeys() {
  return TableOf<sim::Cylinder>()
      .metres("height", &sim::Cylinder::height, size("From its foot to its top."))
      .metres("radius", &sim::Cylinder::radius, size("All the way up."))
      .shared();
}

std::shared_ptr<const Table> sphereKeys() {
  return TableOf<sim::Sphere>().metres("radius", &sim::Sphere::radius, size("Half its height.")).shared();
}

std::shared_ptr<const Table> ellipsoidKeys() {
  return TableOf<sim::Ellipsoid>().place("radii", &sim::Ellipsoid::radii, size("Along x, y and z.")).shared();
}

std::shared_ptr<const Table> boxKeys() {
  return TableOf<sim::Box>().place("size", &sim::Box::size, size("Along x, y and z.")).shared();
}

std::shared_ptr<const Table> revolutionKeys() {
  return TableOf<ProfileSpec>()
      .outline("profile", &ProfileSpec::profile_m,
               {.unit = kMetres,
                .limits = {0.0, kMostOfEnvelope_m},
                .meaning = "A cubic Bezier curve by its four control points [height, radius], from below.",
                .required = true,
                .most = 4})
      .shared();
}

}  // namespace detail

std::vector<std::string> solidsIn(const EnvelopeSpec& spec) {
  std::vector<std::string> names;
  if (spec.cone) names.emplace_back("cone");
  if (spec.dome) names.emplace_back("dome");
  if (spec.cylinder) names.emplace_back("cylinder");
  if (spec.sphere) names.emplace_back("sphere");
  if (spec.ellipsoid) names.emplace_back("ellipsoid");
  if (spec.box) names.emplace_back("box");
  if (spec.revolution) names.emplace_back("revolution");
  return names;
}

sim::Envelope envelopeOf(const EnvelopeSpec& spec, sim::Vec3 foot_m) {
  if (spec.cone) return {*spec.cone, foot_m};
  if (spec.dome) return {*spec.dome, foot_m};
  if (spec.cylinder) return {*spec.cylinder, foot_m};
  if (spec.sphere) return {*spec.sphere, foot_m};
  if (spec.ellipsoid) return {*spec.ellipsoid, foot_m};
  if (spec.box) return {*spec.box, foot_m};
  if (!spec.revolution || spec.revolution->profile_m.size() != 4)
    throw sim::BrokenContract("an envelope was asked for that no file states");
  return {revolutionOf(*spec.revolution), foot_m};
}

sim::Strewing strewingOf(const StrewingSpec& spec) {
  sim::Strewing strewing{static_cast<std::size_t>(spec.count.value_or(kUsualPoints)), spec.spread, {}};
  for (const glm::dvec2& at : spec.density) strewing.density.push_back({at.x, at.y});
  return strewing;
}

void checkEnvelope(const EnvelopeSpec& spec, const std::string& path, const Check::Complain& complain) {
  const auto solids = solidsIn(spec);
  if (solids.size() != 1) return;
  if (spec.revolution && spec.revolution->profile_m.size() != 4) {
    complain(path + ".revolution.profile",
             fmt::format("a profile of {}; expected four, the control points of a Bezier curve",
                         sim::counted(spec.revolution->profile_m.size(), "point")));
    return;
  }
  try {
    sim::requireSound(envelopeOf(spec, sim::Vec3(0.0)));
  } catch (const sim::InputError& error) {
    complain(path + "." + solids.front(), error.what());
  }
}

void checkStrewing(const StrewingSpec& spec, const std::string& path, const Check::Complain& complain) {
  try {
    sim::requireSound(strewingOf(spec));
  } catch (const sim::InputError& error) {
    complain(path + ".density", error.what());
  }
}

void checkCrown(const CrownSpec& spec, const std::string& path, const Check::Complain& complain) {
  const auto solids = solidsIn(spec.shape);
  if (solids.empty()) {
    complain(path, "a crown without a shape; expected one, such as dome: {radius: 6 m}");
  } else if (solids.size() > 1) {
    complain(path + "." + solids[1],
             fmt::format("a crown of {}; expected one shape", fmt::join(solids, " and ")));
  }
  checkEnvelope(spec.shape, path, complain);
  checkStrewing(spec.strewing, path, complain);
}

std::shared_ptr<const Table> crownKeys() {
  TableOf<CrownSpec> table;
  addSolids(table, &CrownSpec::shape);
  table.metres("trunk", &CrownSpec::trunk_m,
               {.unit = kMetres,
                .limits = {-kMostOfEnvelope_m, kMostOfEnvelope_m},
                .meaning = "From the seed up to the crown's foot; below 0 down, as for roots."});
  addStrewing(table, &CrownSpec::strewing);
  return table.shared();
}

}  // namespace espalier::rules
