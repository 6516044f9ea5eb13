#include "render/model/limbs.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "sim/base/parallel.h"
#include "sim/base/random.h"

namespace espalier::render {
namespace {

using sim::NodeId;
using sim::Vec3;

constexpr int kMostStations = 8;        // in a segment
constexpr double kRootDepth = 1.0;      // voxel widths that a seed's stem reaches back into the ground ..
constexpr double kRootRadii = 0.5;      // .. and radii beside
constexpr double kLeastStep = 0.05;     // radii between two stations
constexpr double kTipRadius = 0.7;      // of the last segment's
constexpr double kFootRadii = 1.25;     // how much wider than its limb a foot is
constexpr double kWidest = 0.45 * kPi;  // half of the angle of the widest foot
constexpr double kBeside = 1.0;    // radii of the thinnest twig that a centre line may be off, or the error:
                                   // a tube beside its place looks right, a thin or edged one does not
constexpr double kBent = 0.1;      // radii that a centre line may be off ..
constexpr double kThinner = 0.2;   // and of their radii
constexpr double kOff = 0.9;       // of what is allowed that is left to stations that are left out
constexpr double kTurned = 0.98;   // cosine of the angle between a chord and what it stands for ..
constexpr double kSmooth = 0.99;  // .. on limbs that are so many times as thick as the thinnest twig
constexpr double kThick = 4.0, kThickErrors = 10.0;  // and in errors
constexpr double kLongest = 2.5;  // radii from where a line leaves its host to its first ring
constexpr double kClear = 0.1;    // radii between the first ring and the host's surface

double widening(int sides) {
  return kPi / (sides * std::sin(kPi / sides));
}

/// The radius of the thinnest twig, voxel widths.
double thinnest(const LimbData& data) {
  return data.radii_vx.empty() ? 0.0 : *std::min_element(data.radii_vx.begin(), data.radii_vx.end());
}

/// Half way between a limb's radius at its foot, which is seen best, and what it has on the mean.
double typicalRadius(std::span<const TubeStation> line) {
  double length = 0.0, sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double step = glm::distance(line[i].centre_m, line[i - 1].centre_m);
    length += step;
    sum += step * 0.5 * (line[i].radius_m + line[i - 1].radius_m);
  }
  return 0.5 * (line.front().radius_m + (length > 0.0 ? sum / length : line.front().radius_m));
}

/// How a stem leaves its host: the parameters at which its centre line does, and at which a whole ring has.
struct Leaving {
  bool leaves = false;
  double exit = 0.0, clear = 0.0;
  NearLine place, cleared;  // at the exit, or of the tip; where the ring is
};

/// `v` turned as one has to turn to get from one unit vector to another by the shortest way.
Vec3 turned(Vec3 v, Vec3 from, Vec3 to) {
  const Vec3 axis = glm::cross(from, to);
  const double cosine = glm::dot(from, to);
  if (cosine < -0.999) return v;
  const Vec3 once = glm::cross(axis, v);
  return v + once + glm::cross(axis, once) / (1.0 + cosine);
}

class Builder {
 public:
  Builder(const StemCurves& curves, const LimbData& data, const sim::Frame& frame, double error_m)
      : curves_(curves),
        data_(data),
        frame_(frame),
        error_m_(error_m),
        along_m_(std::max(error_m, kBeside * thinnest(data) * frame.voxel_m)),
        thick_m_(std::max(kThick * thinnest(data) * frame.voxel_m, kThickErrors * error_m)),
        limbs_(curves.stems.size()) {}

  void build(std::size_t s);
  std::vector<Limb> take() { return std::move(limbs_); }

 private:
  const StemCurve& stem(std::size_t s) const { return curves_.stems[s]; }
  Vec3 position(std::size_t s, double t) const {
    return sim::worldFromVoxel(frame_, stem(s).curve.position(t));
  }
  double radiusAt(std::size_t s, double t) const;
  TubeStation stationAt(std::size_t s, double t) const;
  Leaving leaving(std::size_t s, const Limb& host, std::size_t fork_stretch) const;
  int piecesIn(std::size_t s, std::size_t segment) const;
  void addStations(Limb& limb, std::size_t s, double from) const;
  /// Whether a tip is worth being thinner than its twig.
  bool tapers(const Limb& limb) const { return error_m_ < limb.line.back().radius_m; }
  void leaveOutStraight(Limb& limb) const;
  void standOnHost(Limb& limb, std::size_t s) const;
  Vec3 footFor(Limb& limb, const Limb& host, const Leaving& leaving, Vec3 exit_m, Vec3 way) const;
  void finish(Limb& limb, Vec3 across) const;

  const StemCurves& curves_;
  const LimbData& data_;
  const sim::Frame& frame_;
  double error_m_, along_m_, thick_m_;
  std::vector<Limb> limbs_;
};

/// At its fork a stem is as thick as its own first segment, not as its host.
double Builder::radiusAt(std::size_t s, double t) const {
  const std::vector<NodeId>& nodes = stem(s).nodes;
  const auto of = [&](std::size_t i) {
    return static_cast<double>(at(data_.radii_vx, nodes[std::clamp<std::size_t>(i, 1, nodes.size() - 1)]));
  };
  const auto i = static_cast<std::size_t>(std::max(t, 0.0));
  return (of(i) + (std::max(t, 0.0) - static_cast<double>(i)) * (of(i + 1) - of(i))) * frame_.voxel_m;
}

TubeStation Builder::stationAt(std::size_t s, double t) const {
  const std::vector<NodeId>& nodes = stem(s).nodes;
  const auto i = std::min(static_cast<std::size_t>(std::max(t, 0.0)), nodes.size() - 2);
  const auto u = static_cast<float>(std::max(t, 0.0) - static_cast<double>(i));
  const auto mixed = [&](const std::vector<float>& data) {
    return (1.0f - u) * at(data, nodes[i]) + u * at(data, nodes[i + 1]);
  };
  return {position(s, t), radiusAt(s, t), mixed(data_.exposures), mixed(data_.youths)};
}

/// So many that a chord is at most the error away from its curve.
int Builder::piecesIn(std::size_t s, std::size_t segment) const {
  const StemLine& curve = stem(s).curve;
  const auto t = static_cast<double>(segment);
  const Vec3 a = curve.position(t), b = curve.position(t + 1.0), middle = curve.position(t + 0.5);
  const Vec3 before = curve.position(t + 0.25), after = curve.position(t + 0.75);
  const auto off = [](Vec3 p, Vec3 from, Vec3 to) { return glm::distance(p, 0.5 * (from + to)); };
  const double sagitta =
      std::max({off(middle, a, b), 4.0 * off(before, a, middle), 4.0 * off(after, middle, b)});
  const double error_m = (1.0 - kOff) * std::max(along_m_, kBent * radiusAt(s, t + 0.5));
  const double pieces = std::sqrt(sagitta * frame_.voxel_m / error_m);
  return std::clamp(static_cast<int>(std::ceil(pieces)), 1, kMostStations);
}

Leaving Builder::leaving(std::size_t s, const Limb& host, std::size_t fork_stretch) const {
  const StemLine& curve = stem(s).curve;
  Leaving result;
  result.place.stretch = fork_stretch;
  const double last = curve.last();
  const auto stepped = [&](double t, double way_m, double most = 0.5) {
    const double speed = std::max(glm::length(curve.derivative(t)) * frame_.voxel_m, 1e-9);
    return t + std::min(way_m / speed, most);
  };
  double before = 0.0, gap_before = 0.0, t = 0.0;
  for (;;) {
    result.place = nearestOn(host, result.place.stretch, position(s, t));
    const double gap = result.place.radius_m - result.place.distance_m;
    if (gap <= 0.0) {
      if (gap < 0.0 && gap_before > 0.0) t = before + (t - before) * gap_before / (gap_before - gap);
      result.place = nearestOn(host, result.place.stretch, position(s, t));
      break;
    }
    if (t >= last) return result;
    before = t;
    gap_before = gap;
    t = std::min(stepped(t, std::max(gap, 0.1 * result.place.radius_m)), last);
  }
  result.exit = t;
  // Limbs that hardly part run into each other for a while, as grown ones do; a slot as long would look
  // worse.
  const double limit = std::min(t + 0.7 * (last - t), stepped(t, kLongest * radiusAt(s, t), last));
  NearLine near = result.place;
  for (;;) {
    const double radius = widening(sidesFor(radiusAt(s, t), error_m_)) * radiusAt(s, t);
    const Vec3 way = curve.derivative(t);
    const double speed = glm::length(way);
    const Vec3 out = (position(s, t) - near.centre_m) / std::max(near.distance_m, 1e-12);
    const double along = speed > 0.0 ? glm::dot(way, out) / speed : 1.0;
    const double reach = radius * std::sqrt(std::max(1.0 - along * along, 0.0));
    const double gap = near.radius_m + reach + kClear * radius - near.distance_m;
    if (gap <= 0.0 || t >= limit) break;
    t = std::min(stepped(t, std::max(gap, 0.15 * radius)), limit);
    near = nearestOn(host, near.stretch, position(s, t));
  }
  result.clear = t;
  result.cleared = near;
  result.leaves = result.exit < last;
  return result;
}

void Builder::addStations(Limb& limb, std::size_t s, double from) const {
  const auto add = [&](double t) {
    const TubeStation station = stationAt(s, t);
    if (!limb.line.empty() &&
        glm::distance(station.centre_m, limb.line.back().centre_m) < kLeastStep * station.radius_m)
      return;
    limb.line.push_back(station);
    limb.params.push_back(t);
  };
  add(from);
  const std::size_t segments = stem(s).nodes.size() - 1;
  for (auto segment = static_cast<std::size_t>(from); segment < segments; ++segment) {
    const int pieces = piecesIn(s, segment);
    for (int k = 1; k <= pieces; ++k) {
      const double t = static_cast<double>(segment) + static_cast<double>(k) / pieces;
      if (t > from) add(t);
    }
  }
}

/// Leaves out stations that lie where their neighbours would have them anyway.
void Builder::leaveOutStraight(Limb& limb) const {
  constexpr std::size_t kFarthest = 12;  // stations in a row
  std::vector<std::size_t> kept{0};
  const auto between = [&](std::size_t a, std::size_t b) {
    const TubeStation &p = limb.line[a], &q = limb.line[b];
    const Vec3 step = q.centre_m - p.centre_m;
    const double length2 = glm::dot(step, step);
    for (std::size_t i = a; i < b; ++i) {
      const Vec3 way = limb.line[i + 1].centre_m - limb.line[i].centre_m;
      const double turned = limb.line[i].radius_m > thick_m_ ? kSmooth : kTurned;
      if (glm::dot(way, step) < turned * glm::length(way) * std::sqrt(length2)) return false;
    }
    for (std::size_t i = a + 1; i < b; ++i) {
      const TubeStation& station = limb.line[i];
      const double share = length2 > 0.0 ? glm::dot(station.centre_m - p.centre_m, step) / length2 : 0.5;
      if (!(share > 0.0 && share < 1.0)) return false;
      const double off = glm::distance(station.centre_m, p.centre_m + share * step);
      const double thinner = std::abs(station.radius_m - glm::mix(p.radius_m, q.radius_m, share));
      if (off > kOff * std::max(along_m_, kBent * station.radius_m)) return false;
      if (thinner > kThinner * station.radius_m) return false;
    }
    return true;
  };
  for (std::size_t i = 2; i < limb.line.size(); ++i) {
    if (i - kept.back() > kFarthest || !between(kept.back(), i)) kept.push_back(i - 1);
  }
  kept.push_back(limb.line.size() - 1);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    limb.line[k] = limb.line[kept[k]];
    limb.params[k] = limb.params[kept[k]];
  }
  limb.line.resize(kept.size());
  limb.params.resize(kept.size());
}

/// Sets the foot: from where the centre line leaves the host to below its first ring. Returns where the rings
/// begin to be counted: on the side that looks along the host.
Vec3 Builder::footFor(Limb& limb, const Limb& host, const Leaving& leaving, Vec3 exit_m, Vec3 way) const {
  const TubeStation& ring = limb.line.front();
  const double exit_arc = arcOf(host, leaving.place), ring_arc = arcOf(host, leaving.cleared);
  const Section section = sectionAt(host, 0.5 * (exit_arc + ring_arc));
  const auto outOf = [&](Vec3 p, double arc) {
    const Vec3 out = p - stationOn(host, arc).centre_m;
    return out - glm::dot(out, section.frame.along) * section.frame.along;
  };
  Vec3 out = outOf(exit_m, exit_arc) + outOf(ring.centre_m, ring_arc);
  if (glm::length(out) < 1e-3 * section.radius_m)
    out = way - glm::dot(way, section.frame.along) * section.frame.along;
  if (glm::length(out) < 1e-6) out = section.frame.across;
  out = glm::normalize(out);

  const double radius = kFootRadii * ring.radius_m;
  const double slope = glm::dot(way, section.frame.along);
  const double reach = radius * std::sqrt(std::max(1.0 - slope * slope, 0.0));  // of the ring along the host
  const double low = std::min(exit_arc - radius, ring_arc - reach);
  const double high = std::max(exit_arc + radius, ring_arc + reach);
  Foot& foot = limb.foot;
  foot.arc_m = 0.5 * (low + high);
  foot.half_arc_m = 0.5 * (high - low);
  foot.angle = std::atan2(glm::dot(out, section.frame.up), glm::dot(out, section.frame.across));
  foot.half_angle = std::min(kWidest, std::asin(std::min(1.0, radius / std::max(section.radius_m, 1e-12))));
  return turned(section.frame.along, out, way);
}

void Builder::standOnHost(Limb& limb, std::size_t s) const {
  const NodeId fork = stem(s).nodes.front();
  auto host = static_cast<std::size_t>(at(curves_.stem_of, fork));
  double param = at(curves_.parameter_of, fork);
  // A fork inside a limb farther down leaves that one.
  while (limbs_[host].host >= 0 && param < limbs_[host].params.front() - 1e-9) {
    const NodeId lower = stem(host).nodes.front();
    param = at(curves_.parameter_of, lower);
    host = static_cast<std::size_t>(at(curves_.stem_of, lower));
  }
  const Limb& on = limbs_[host];
  limb.host = static_cast<std::int32_t>(host);
  Leaving way = leaving(s, on, stretchAt(on, param));
  if (way.leaves) addStations(limb, s, way.clear);
  if (limb.line.size() < 2) {  // a bud
    const TubeStation tip = stationAt(s, stem(s).curve.last());
    const Section section = sectionAt(on, arcOf(on, way.place));
    Vec3 out = tip.centre_m - section.centre_m;
    out -= glm::dot(out, section.frame.along) * section.frame.along;
    out = glm::length(out) > 1e-3 * section.radius_m ? glm::normalize(out) : section.frame.across;
    limb.line.assign(2, tip);
    limb.line[0].centre_m = section.centre_m + (section.radius_m + 0.3 * tip.radius_m) * out;
    limb.line[1].centre_m = limb.line[0].centre_m + tip.radius_m * out;
    limb.params = {stem(s).curve.last() - 0.5, stem(s).curve.last()};
    way.cleared = way.place;
    return finish(limb, footFor(limb, on, way, limb.line[0].centre_m, out));
  }
  const Vec3 begins = glm::normalize(limb.line[1].centre_m - limb.line[0].centre_m);
  finish(limb, footFor(limb, on, way, position(s, way.exit), begins));
}

/// Widens the rings, and fills in what follows from the stations.
void Builder::finish(Limb& limb, Vec3 across) const {
  if (limb.line.size() > 2) leaveOutStraight(limb);
  limb.sides = sidesFor(typicalRadius(limb.line), error_m_);
  if (tapers(limb)) limb.line.back().radius_m *= kTipRadius;
  std::vector<bool> left_out(limb.line.size(), false);
  const std::vector<Vec3> along = keepRingsApart(limb.line, [&](std::size_t i) { left_out[i] = true; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < limb.params.size(); ++i) {
    if (!left_out[i]) limb.params[kept++] = limb.params[i];
  }
  limb.params.resize(kept);
  limb.arcs_m.assign(1, 0.0);
  for (std::size_t i = 1; i < limb.line.size(); ++i)
    limb.arcs_m.push_back(limb.arcs_m.back() +
                          glm::distance(limb.line[i].centre_m, limb.line[i - 1].centre_m));
  limb.frames = rotationMinimizingFrames(limb.line, along, across);
  for (TubeStation& station : limb.line) station.radius_m *= widening(limb.sides);
}

void Builder::build(std::size_t s) {
  Limb& limb = limbs_[s];
  limb.order = stem(s).order;
  limb.off_m = along_m_;
  if (!stem(s).from_seed) return standOnHost(limb, s);
  const Vec3 start = stem(s).curve.derivative(0.0);
  const Vec3 way = glm::length(start) > 0.0 ? glm::normalize(start) : Vec3(0, 1, 0);
  TubeStation root = stationAt(s, 0.0);
  root.centre_m -= (kRootDepth * frame_.voxel_m + kRootRadii * root.radius_m) * way;
  limb.line.push_back(root);
  limb.params.push_back(-1.0);
  addStations(limb, s, 0.0);
  finish(limb, std::abs(way.y) < 0.9 ? glm::cross(Vec3(0, 1, 0), way) : glm::cross(Vec3(1, 0, 0), way));
}

}  // namespace

std::vector<Limb> limbsOf(const StemCurves& curves, const LimbData& data, const sim::Frame& frame,
                          double error_m) {
  Builder builder(curves, data, frame, error_m);
  // Each generation of stems stands on those before it.
  for (std::size_t g = 0; g + 1 < curves.generations.size(); ++g) {
    const std::size_t first = curves.generations[g];
    sim::parallelFor(curves.generations[g + 1] - first, 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) builder.build(first + i);
    });
  }
  return builder.take();
}

}  // namespace espalier::render
