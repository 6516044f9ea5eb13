#include "rules/growth/ways.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rules/growth/ways.cpp"
// Vectors whose length is known when compiling.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

#include "sim/base/random_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace espalier::rules::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Whole = hn::ScalableTag<std::int32_t>;
using Words = hn::ScalableTag<std::uint32_t>;
using F = hn::Vec<Floats>;

// Never MulAdd, which rounds once where the processor has it and twice where it has not.
struct Direction {
  F x, y, z;
};

HWY_INLINE F set(float value) {
  return hn::Set(Floats(), value);
}

HWY_INLINE Direction set(sim::Vec3f v) {
  return {set(v.x), set(v.y), set(v.z)};
}

HWY_INLINE Direction scaled(Direction a, F by) {
  return {hn::Mul(a.x, by), hn::Mul(a.y, by), hn::Mul(a.z, by)};
}

HWY_INLINE Direction sum(Direction a, Direction b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}

HWY_INLINE Direction cross(Direction a, Direction b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}

HWY_INLINE F length(Direction a) {
  return hn::Sqrt(hn::Add(hn::Add(hn::Mul(a.x, a.x), hn::Mul(a.y, a.y)), hn::Mul(a.z, a.z)));
}

HWY_INLINE Direction divided(Direction a, F by) {
  return {hn::Div(a.x, by), hn::Div(a.y, by), hn::Div(a.z, by)};
}

template <class Mask>
HWY_INLINE Direction chosen(Mask mask, Direction yes, Direction no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y),
          hn::IfThenElse(mask, yes.z, no.z)};
}

/// Cosine and sine of full turns (not negative), by Taylor's series within an eighth of a turn.
struct Circle {
  F cosine, sine;
};
HWY_INLINE Circle circle(F turns) {
  const Floats d;
  const Whole whole;
  const F quarters = hn::Floor(hn::Add(hn::Mul(turns, set(4.0f)), set(0.5f)));
  const F x = hn::Mul(hn::Sub(turns, hn::Mul(quarters, set(0.25f))), set(6.28318530717958648f));
  const F x2 = hn::Mul(x, x);
  F s = hn::Mul(x2, set(1.0f / 362880));
  s = hn::Mul(hn::Add(s, set(-1.0f / 5040)), x2);
  s = hn::Mul(hn::Add(s, set(1.0f / 120)), x2);
  s = hn::Mul(hn::Add(s, set(-1.0f / 6)), x2);
  s = hn::Add(x, hn::Mul(x, s));
  F c = hn::Mul(x2, set(1.0f / 40320));
  c = hn::Mul(hn::Add(c, set(-1.0f / 720)), x2);
  c = hn::Mul(hn::Add(c, set(1.0f / 24)), x2);
  c = hn::Mul(hn::Add(c, set(-1.0f / 2)), x2);
  c = hn::Add(c, set(1.0f));
  const auto quarter = hn::ConvertTo(whole, quarters);
  const auto bit = [&](int k) { return hn::Set(whole, k); };
  const auto odd = hn::RebindMask(d, hn::TestBit(quarter, bit(1)));
  const auto half = hn::RebindMask(d, hn::TestBit(quarter, bit(2)));
  const auto turned = hn::RebindMask(d, hn::TestBit(hn::Add(quarter, bit(1)), bit(2)));
  const F across = hn::IfThenElse(odd, s, c), up = hn::IfThenElse(odd, c, s);
  return {hn::IfThenElse(turned, hn::Neg(across), across), hn::IfThenElse(half, hn::Neg(up), up)};
}

HWY_INLINE Direction perpendicular(Direction unit) {
  const F x = hn::Abs(unit.x), y = hn::Abs(unit.y), z = hn::Abs(unit.z), none = set(0.0f);
  const Direction with_x{none, unit.z, hn::Neg(unit.y)}, with_y{hn::Neg(unit.z), none, unit.x},
      with_z{unit.y, hn::Neg(unit.x), none};
  const Direction across =
      chosen(hn::And(hn::Le(x, y), hn::Le(x, z)), with_x, chosen(hn::Le(y, z), with_y, with_z));
  return divided(across, length(across));
}

/// A unit axis and what stands across it.
struct Axes {
  Direction axis, u, v;

  HWY_INLINE explicit Axes(Direction unit) : axis(unit), u(perpendicular(unit)), v(cross(unit, u)) {}
};

/// The unit vector at an angle to an axis, on the side that a turn about it gives.
HWY_INLINE Direction leaning(const Axes& to, F along, F across, F turn) {
  const Circle side = circle(turn);
  return sum(scaled(to.axis, along), scaled(sum(scaled(to.u, side.cosine), scaled(to.v, side.sine)), across));
}

/// The numbers of a batch of trials, drawn four at a time where somebody asks.
struct Numbers {
  const Ways& ways;
  hn::Vec<Words> trials;
  static constexpr std::size_t kBlocks = (kTrialSlots + 3) / 4;
  sim::HWY_NAMESPACE::FourNumbers<Words> four[kBlocks];
  bool drawn[kBlocks] = {};

  HWY_INLINE F uniform(TrialSlot slot) {
    const auto number = static_cast<unsigned>(slot), block = number / 4;
    if (!drawn[block]) four[block] = sim::HWY_NAMESPACE::fourNumbers(Words(), ways.numbers, trials, block);
    drawn[block] = true;
    return sim::HWY_NAMESPACE::uniformOf(Floats(), four[block].of[number % 4]);
  }
  HWY_INLINE F value(Spread spread, TrialSlot slot) {
    if (spread.span == 0.0f) return set(spread.low);
    return hn::Add(set(spread.low), hn::Mul(set(spread.span), uniform(slot)));
  }
};

HWY_INLINE Direction bent(Direction direction, const Pull& pull, Numbers& numbers) {
  const F signed_weight = numbers.value(pull.weight, pull.slot), weight = hn::Abs(signed_weight);
  Direction towards = set(pull.towards);
  towards = chosen(hn::Lt(signed_weight, set(0.0f)),
                   Direction{hn::Neg(towards.x), hn::Neg(towards.y), hn::Neg(towards.z)}, towards);
  const Direction mixed = sum(scaled(direction, hn::Sub(set(1.0f), weight)), scaled(towards, weight));
  const F long_ = length(mixed);
  const auto bends = hn::And(hn::Gt(long_, set(1e-6f)), hn::Gt(weight, set(0.0f)));
  return chosen(bends, divided(mixed, long_), direction);
}

/// In degrees, not yet limited. `narrow`: all trials are before those that wander farther and farther.
HWY_INLINE F widened(const Ways& ways, bool narrow, hn::Vec<Whole> trial, Numbers& numbers) {
  F wander = numbers.value(ways.wander_deg, TrialSlot::wander);
  if (narrow) {
    if (ways.narrowly != 1.0f) wander = hn::Mul(set(ways.narrowly), wander);
  } else {
    const F beyond = hn::ConvertTo(Floats(), hn::Sub(trial, hn::Set(Whole(), ways.narrow - 1)));
    const F share = hn::Div(beyond, set(static_cast<float>(std::max(1, ways.widest - ways.narrow))));
    wander = hn::Mul(hn::Add(set(ways.narrowly), hn::Max(set(0.0f), share)), wander);
  }
  return wander;
}

/// The natural logarithm of normal numbers above 0, by the series of the area tangent about 1.
HWY_INLINE F logarithm(F x) {
  constexpr std::int32_t kRootOfHalf = 0x3f3504f3;  // the bits of that number: it begins what is nearest to 1
  const Floats d;
  const Whole whole;
  const auto bits = hn::BitCast(whole, x);
  const auto octave = hn::ShiftRight<23>(hn::Sub(bits, hn::Set(whole, kRootOfHalf)));
  const F m = hn::BitCast(d, hn::Sub(bits, hn::ShiftLeft<23>(octave)));
  const F z = hn::Div(hn::Sub(m, set(1.0f)), hn::Add(m, set(1.0f))), z2 = hn::Mul(z, z);
  F sum = hn::Mul(z2, set(1.0f / 9));
  for (const float term : {1.0f / 7, 1.0f / 5, 1.0f / 3}) sum = hn::Mul(hn::Add(sum, set(term)), z2);
  const F of_m = hn::Mul(hn::Mul(set(2.0f), z), hn::Add(set(1.0f), sum));
  return hn::Add(hn::Mul(hn::ConvertTo(d, octave), set(0.69314718055994531f)), of_m);
}

/// How far from their middle two normal numbers of deviation 1 lie together, by an even number in [0, 1).
HWY_INLINE F rayleigh(F even) {
  return hn::Sqrt(hn::Mul(set(-2.0f), logarithm(hn::Sub(set(1.0f), even))));
}

/// A share of the angle as a table has it, by an even number in [0, 1).
HWY_INLINE F drawnFrom(const AngleDensity& angles, F even) {
  const auto& first = angles.pieces[0];
  F from = set(first.from), per_share = set(first.per_share), low = set(first.low), rise = set(first.rise),
    at = set(first.at), span = set(first.span);
  for (std::size_t i = 1; i < angles.count; ++i) {
    const auto& piece = angles.pieces[i];
    const auto in = hn::Ge(even, set(piece.from));
    from = hn::IfThenElse(in, set(piece.from), from);
    per_share = hn::IfThenElse(in, set(piece.per_share), per_share);
    low = hn::IfThenElse(in, set(piece.low), low);
    rise = hn::IfThenElse(in, set(piece.rise), rise);
    at = hn::IfThenElse(in, set(piece.at), at);
    span = hn::IfThenElse(in, set(piece.span), span);
  }
  const F part = hn::Min(set(1.0f), hn::Mul(hn::Sub(even, from), per_share));
  const F square = hn::Add(hn::Mul(low, low), hn::Mul(hn::Mul(set(2.0f), rise), part));
  const F below = hn::Add(low, hn::Sqrt(hn::Max(set(0.0f), square)));
  const F along = hn::Div(hn::Mul(set(2.0f), part), hn::Max(set(1e-20f), below));
  return hn::Add(at, hn::Mul(span, hn::Min(set(1.0f), along)));
}

/// How far a trial goes along the way that it wanders from, and how far across. `narrow`: as above.
struct Lean {
  F along, across;
};
HWY_INLINE Lean leanOf(const Ways& ways, bool narrow, hn::Vec<Whole> trial, Numbers& numbers) {
  const F wander = widened(ways, narrow, trial, numbers), even = numbers.uniform(TrialSlot::cone_height);
  const auto circleOf = [](F degrees) {
    return circle(hn::Mul(hn::Min(set(180.0f), degrees), set(1.0f / 360)));
  };
  if (ways.wanders == AngleDistribution::cone) {
    // Even in height is even on the sphere (Archimedes).
    const F along = hn::Sub(set(1.0f), hn::Mul(even, hn::Sub(set(1.0f), circleOf(wander).cosine)));
    return {along, hn::Sqrt(hn::Max(set(0.0f), hn::Sub(set(1.0f), hn::Mul(along, along))))};
  }
  const bool gaussian = ways.wanders == AngleDistribution::gaussian;
  const Circle lean = circleOf(hn::Mul(wander, gaussian ? rayleigh(even) : drawnFrom(ways.angles, even)));
  return {lean.cosine, lean.sine};
}

/// `axes`: of the limb; `narrow`: as above.
HWY_INLINE Direction directionOf(const Ways& ways, const Axes& axes, bool narrow, hn::Vec<Whole> trial,
                                 Numbers& numbers) {
  const auto [along, across] = leanOf(ways, narrow, trial, numbers);
  const F turn = numbers.uniform(TrialSlot::cone_turn);
  Direction direction = axes.axis;
  if (ways.branch) {
    const Circle angle =
        circle(hn::Mul(numbers.value(ways.side_angle_deg, TrialSlot::side_angle), set(1.0f / 360)));
    const Axes side(leaning(axes, angle.cosine, angle.sine, numbers.uniform(TrialSlot::side_turn)));
    direction = leaning(side, along, across, turn);
  } else {
    direction = leaning(axes, along, across, turn);
  }
  for (std::size_t i = 0; i < ways.pull_count; ++i) direction = bent(direction, ways.pulls[i], numbers);
  if (ways.flat[0] || ways.flat[1] || ways.flat[2]) {
    if (ways.flat[0]) direction.x = set(0.0f);
    if (ways.flat[1]) direction.y = set(0.0f);
    if (ways.flat[2]) direction.z = set(0.0f);
    const F left = length(direction);
    direction = chosen(hn::Gt(left, set(1e-6f)), divided(direction, left), set(sim::Vec3f(0.0f)));
  }
  return direction;
}

void TrialEnds(const Ways& ways, unsigned first, std::size_t count, sim::Offsets& ends) {
  const Whole whole;
  const Words words;
  const Axes axes(set(ways.axis));
  const bool narrow = first + count <= static_cast<std::size_t>(std::max(0, ways.narrow));
  for (std::size_t i = 0; i < count; i += hn::Lanes(whole)) {
    const auto trial = hn::Iota(whole, static_cast<std::int32_t>(first + i));
    Numbers numbers{
        ways,
        hn::Or(hn::Set(words, ways.numbers.counter[3]), hn::ShiftLeft<8>(hn::BitCast(words, trial))),
        {}};
    const Direction direction = directionOf(ways, axes, narrow, trial, numbers);
    const F length = hn::Mul(numbers.value(ways.length_vx, TrialSlot::length), set(sim::Offsets::kToAVoxel));
    hn::Store(hn::NearestInt(hn::Mul(direction.x, length)), whole, ends.x + i);
    hn::Store(hn::NearestInt(hn::Mul(direction.y, length)), whole, ends.y + i);
    hn::Store(hn::NearestInt(hn::Mul(direction.z, length)), whole, ends.z + i);
  }
}

}  // namespace espalier::rules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::rules {

HWY_EXPORT(TrialEnds);

Spread spreadOf(const Value& value, const Circumstance& at) {
  if (value.kind == Value::Kind::range)
    return {static_cast<float>(value.low), static_cast<float>(value.high - value.low)};
  return {static_cast<float>(evaluate(value, at, 0.0)), 0.0f};
}

Ways waysOf(const RuleSet& rules, const Surroundings& around, const Senses& senses, const sim::RandomKey& key,
            unsigned set, sim::Voxel world_size) {
  const RandomTree& tree = rules.random_tree;
  Ways ways;
  ways.numbers = sim::philoxInput(key, sim::Purpose::trial, set);
  if (around.heading == sim::Vec3(0.0)) {
    // A seed has no way of its own yet: a shoot makes for the open above, or along the wall that it stands
    // at; where limbs may turn farther than that, as far as they.
    const Spread wander = spreadOf(tree.wander_deg, senses.circumstance);
    ways.wander_deg = {std::max(60.0f, wander.low + wander.span), 0.0f};
    ways.narrow = tree.trials_max;
  } else {
    ways.axis = sim::Vec3f(around.heading);
    ways.branch = key.number != 0;
    ways.side_angle_deg = spreadOf(tree.branch_angle_deg, senses.circumstance);
    ways.wander_deg = spreadOf(tree.wander_deg, senses.circumstance);
    ways.wanders = tree.distribution();
    if (ways.wanders == AngleDistribution::table) ways.angles = angleDensityOf(tree.wander_table);
    ways.narrow = tree.trials_min;
  }
  ways.widest = tree.trials_max;
  ways.length_vx = spreadOf(tree.length.value, senses.circumstance);
  bendBy(rules, around, senses, world_size, ways);
  return ways;
}

void bendBy(const RuleSet& rules, const Surroundings& around, const Senses& senses, sim::Voxel world_size,
            Ways& ways) {
  const auto pull = [&](sim::Vec3 towards, const Value& weight, TrialSlot slot) {
    const Spread spread = spreadOf(weight, senses.circumstance);
    if (towards == sim::Vec3(0.0) || (spread.low == 0.0f && spread.span == 0.0f)) return;
    ways.pulls[ways.pull_count++] = {sim::Vec3f(towards), spread, slot};
  };
  pull({0, 1, 0}, rules.bias.up, TrialSlot::up);
  pull({0, -1, 0}, rules.bias.gravity, TrialSlot::gravity);
  pull(senses.light, rules.bias.light, TrialSlot::light);
  pull(around.away, rules.bias.away, TrialSlot::away);
  pull(-around.away, rules.bias.toward, TrialSlot::toward);
  pull(senses.twist, rules.bias.twist, TrialSlot::twist);
  pull(senses.apex, rules.bias.apex, TrialSlot::apex);
  for (std::size_t i = 0; i < rules.bias.towards.size(); ++i)
    pull(senses.towards[i], rules.bias.towards[i].amount,
         static_cast<TrialSlot>(static_cast<std::size_t>(TrialSlot::towards) + i));
  for (std::size_t i = 0; i < rules.bias.senses.size(); ++i)
    pull(senses.sensed[i], rules.bias.senses[i].amount,
         static_cast<TrialSlot>(static_cast<std::size_t>(TrialSlot::sensed) + i));
  for (int axis = 0; axis < 3; ++axis) ways.flat[static_cast<std::size_t>(axis)] = world_size[axis] == 1;
}

void trialEnds(const Ways& ways, unsigned first, std::size_t count, sim::Offsets& ends) {
  HWY_DYNAMIC_DISPATCH(TrialEnds)(ways, first, count, ends);
}

}  // namespace espalier::rules
#endif
