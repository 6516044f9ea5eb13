#include "rules/front/leaf.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "rules/front/leaf.cpp"
// Vectors whose length is known when compiling.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#include <hwy/foreach_target.h>
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace espalier::rules::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::ScalableTag<double>;
using D = hn::Vec<Doubles>;

HWY_INLINE D squareOf(D a) {
  return hn::Mul(a, a);
}

/// The three summed from the least on. Never MulAdd: see distance2.
HWY_INLINE D sumOf(D a, D b, D c) {
  const D least = hn::Min(a, hn::Min(b, c)), most = hn::Max(a, hn::Max(b, c));
  const D middle = hn::Max(hn::Min(a, b), hn::Min(hn::Max(a, b), c));
  return hn::Add(hn::Add(least, middle), most);
}

void ComeBy(Leaf& leaf, std::span<const std::int64_t> which, PointList points, double influence2) {
  const Doubles d;
  const D reach = hn::Set(d, influence2);
  for (std::size_t i = 0; i < leaf.count; i += hn::Lanes(d)) {
    const D x = hn::Load(d, leaf.x + i), y = hn::Load(d, leaf.y + i), z = hn::Load(d, leaf.z + i);
    D nearest2 = hn::Load(d, leaf.nearest2 + i), nearest = hn::Load(d, leaf.nearest + i);
    D new2 = hn::Load(d, leaf.new2 + i);
    for (const std::int64_t node : which) {
      const D away2 = sumOf(squareOf(hn::Sub(x, hn::Set(d, points.x[node]))),
                            squareOf(hn::Sub(y, hn::Set(d, points.y[node]))),
                            squareOf(hn::Sub(z, hn::Set(d, points.z[node]))));
      const auto nearer = hn::Lt(away2, hn::Min(nearest2, reach));
      nearest2 = hn::IfThenElse(nearer, away2, nearest2);
      nearest = hn::IfThenElse(nearer, hn::Set(d, static_cast<double>(points.number[node])), nearest);
      new2 = hn::Min(new2, away2);
    }
    hn::Store(nearest2, d, leaf.nearest2 + i);
    hn::Store(nearest, d, leaf.nearest + i);
    hn::Store(new2, d, leaf.new2 + i);
  }
}

/// How far outside of [low, high]; 0 inside.
HWY_INLINE D outside(D at, double low, double high) {
  const Doubles d;
  return hn::Max(hn::Max(hn::Sub(hn::Set(d, low), at), hn::Sub(at, hn::Set(d, high))), hn::Zero(d));
}

std::size_t NearBox(PointList points, std::int64_t* which, std::size_t count, sim::Vec3 low, sim::Vec3 high,
                    double within2) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> whole;
  const D within = hn::Set(d, within2), smaller = hn::Set(d, 1.0 - 1e-14);
  std::int64_t* to = which + count;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const std::size_t left = count - i;
    const auto valid = hn::FirstN(whole, left);
    const auto index = hn::IfThenElseZero(valid, hn::LoadU(whole, which + i));
    const D x = outside(hn::GatherIndex(d, points.x, index), low.x, high.x);
    const D y = outside(hn::GatherIndex(d, points.y, index), low.y, high.y);
    const D z = outside(hn::GatherIndex(d, points.z, index), low.z, high.z);
    const D away2 = hn::Mul(hn::Add(hn::Add(squareOf(x), squareOf(y)), squareOf(z)), smaller);
    const auto near = hn::And(hn::RebindMask(whole, hn::Lt(away2, within)), valid);
    to += hn::CompressStore(index, near, whole, to);
  }
  return static_cast<std::size_t>(to - (which + count));
}

}  // namespace espalier::rules::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace espalier::rules {

HWY_EXPORT(ComeBy);
HWY_EXPORT(NearBox);

void comeBy(Leaf& leaf, std::span<const std::int64_t> which, PointList points, double influence2) {
  HWY_DYNAMIC_DISPATCH(ComeBy)(leaf, which, points, influence2);
}

std::size_t nearBox(PointList points, std::int64_t* which, std::size_t count, sim::Vec3 low, sim::Vec3 high,
                    double within2) {
  return HWY_DYNAMIC_DISPATCH(NearBox)(points, which, count, low, high, within2);
}

}  // namespace espalier::rules
#endif
