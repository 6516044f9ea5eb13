#pragma once
#include <string>
#include <utility>
#include <vector>

#include "render/image/image.h"
#include "sim/base/provenance.h"

/// Pictures as the bytes of a file: write them with sim::writeWhole. The same picture gives the same bytes
/// always: nothing of the time or the machine is stamped into them. All functions throw sim::InputError when
/// the encoder fails or a pixel is not a finite number.
namespace espalier::render {

/// Texts kept in the file's header, by name; stored in the order given.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// What says by which program and from what a picture was made: `Software`, `espalier:seed`,
/// `espalier:inputs`.
Metadata textsOf(const sim::Provenance& made_by);

/// 8-bit PNG of display values (sRGB, 0..1; what lies outside is clamped) with 1, 3 or 4 channels; alpha, the
/// fourth, is not premultiplied.
std::string encodePng(const Image& display, const Metadata& metadata = {});

/// A PNG that encodePng made, as display values with three channels; alpha is left out. Throws where it is
/// none.
Image decodePng(const std::string& bytes);

/// EXR of linear or measured values; one name a channel. Quantities are kept exactly, as 32-bit floats;
/// colours, whose first channel is "R", are stored as half floats.
std::string encodeExr(const Image& measured, const std::vector<std::string>& channel_names,
                      const Metadata& metadata = {});

/// Loads what draws and encodes pictures, which otherwise happens with the first of them: for jobs that would
/// learn too late that it is missing.
void makeReadyToDraw();
/// About what of memory that will take: 0 when it was done.
double bytesToBeReady();

}  // namespace espalier::render
