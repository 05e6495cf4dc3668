/// Moving pictures as one file: animated PNG, which browsers play and other programs show as a still.
#pragma once

#include <span>
#include <string>

namespace tessera::post {

/// The frames, PNG files' bytes of one size and kind, shown `seconds` each and the last ten times as long,
/// again and again. What cannot play it shows the last. InputError where a frame is no PNG or unlike the
/// first. PNG specification, third edition (W3C 2025), 11.3.6: chunks acTL, fcTL and fdAT.
std::string animated_png(std::span<const std::string> frames, double seconds);

} // namespace tessera::post
