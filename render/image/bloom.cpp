#include "render/image/bloom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "render/image/tone.h"
#include "sim/base/parallel.h"

namespace espalier::render {
namespace {

struct Lobe {
  double deviation;  // of the picture's height
  float share;       // of what spreads
};
constexpr std::array<Lobe, 3> kLobes{Lobe{0.004, 0.5f}, {0.016, 0.3f}, {0.06, 0.2f}};
constexpr int kBoxes = 3;  // one after the other, they are nearly a Gaussian (Wells 1986)

/// A box of any width: 2 whole + 1 full values, and one of a share on both sides (Gwosdek et al. 2011), with
/// the variance that is asked for.
struct Box {
  int whole = 0;
  double rim = 0.0;

  explicit Box(double variance) {
    whole = static_cast<int>(std::floor(0.5 * (std::sqrt(12.0 * variance + 1.0) - 1.0)));
    const double w = whole, full = 2.0 * w + 1.0;
    rim = full * (w * (w + 1.0) - 3.0 * variance) / (6.0 * (variance - (w + 1.0) * (w + 1.0)));
  }
};

/// Rows of values, each spread along itself. A row goes on beyond its ends as in a mirror, so that as much
/// comes back as goes out.
class Rows {
 public:
  Rows(std::vector<float>& values, std::size_t length) : values_(values), length_(length) {}

  void spread(const Box& box) {
    sim::parallelFor(values_.size() / length_, [&](std::size_t begin, std::size_t end) {
      std::vector<float> row(length_);
      for (std::size_t r = begin; r < end; ++r) {
        float* const out = values_.data() + r * length_;
        std::copy_n(out, length_, row.data());
        const auto value = [&](int i) { return static_cast<double>(row[mirrored(i)]); };
        double sum = 0.0;
        for (int i = -box.whole; i <= box.whole; ++i) sum += value(i);
        const double all = 2.0 * box.whole + 1.0 + 2.0 * box.rim;
        for (int i = 0; i < static_cast<int>(length_); ++i) {
          const double before = value(i - box.whole - 1), after = value(i + box.whole + 1);
          out[i] = static_cast<float>((sum + box.rim * (before + after)) / all);
          sum += after - value(i - box.whole);
        }
      }
    });
  }

 private:
  std::size_t mirrored(int i) const {
    const int length = static_cast<int>(length_);
    const int within = ((i % (2 * length)) + 2 * length) % (2 * length);
    return static_cast<std::size_t>(within < length ? within : 2 * length - 1 - within);
  }

  std::vector<float>& values_;
  std::size_t length_;
};

std::vector<float> turned(const std::vector<float>& rows, std::size_t length) {
  const std::size_t count = rows.size() / length;
  std::vector<float> columns(rows.size());
  for (std::size_t r = 0; r < count; ++r)
    for (std::size_t i = 0; i < length; ++i) columns[i * count + r] = rows[r * length + i];
  return columns;
}

}  // namespace

void bloom(Image& linear, double amount) {
  if (amount == 0.0 || linear.pixels.empty()) return;
  const ToneCurve tone;
  const float white = tone.white / tone.exposure;
  const auto width = static_cast<std::size_t>(linear.width), height = static_cast<std::size_t>(linear.height);
  std::array<std::vector<float>, 3> excess;
  for (auto& channel : excess) channel.resize(width * height);
  bool any = false;
  for (std::size_t i = 0; i < width * height; ++i) {
    float* const pixel = linear.pixels.data() + 3 * i;
    const float most = std::max({pixel[0], pixel[1], pixel[2]});
    if (!(most > white)) continue;
    any = true;
    const float share = static_cast<float>(amount) * (1.0f - white / most);
    for (std::size_t c = 0; c < 3; ++c) {
      excess[c][i] = share * pixel[c];
      pixel[c] -= excess[c][i];
    }
  }
  if (!any) return;
  for (std::size_t c = 0; c < 3; ++c) {
    double variance = 0.0;
    std::vector<float>& spread = excess[c];
    for (std::size_t k = 0; k < kLobes.size(); ++k) {
      // What has spread goes on from there: variances add up.
      const double deviation = kLobes[k].deviation * linear.height;
      const Box box((deviation * deviation - variance) / kBoxes);
      variance = deviation * deviation;
      for (int i = 0; i < kBoxes; ++i) Rows(spread, width).spread(box);
      spread = turned(spread, width);
      for (int i = 0; i < kBoxes; ++i) Rows(spread, height).spread(box);
      spread = turned(spread, height);
      for (std::size_t i = 0; i < spread.size(); ++i) linear.pixels[3 * i + c] += kLobes[k].share * spread[i];
    }
  }
}

}  // namespace espalier::render
