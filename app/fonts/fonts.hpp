#pragma once
// Inter in three weights: the glyphs that the application shows, made by embed_font at build time.

namespace substep {

extern const unsigned char kInterRegular[];
extern const unsigned int kInterRegular_size;
extern const unsigned char kInterMedium[];
extern const unsigned int kInterMedium_size;
extern const unsigned char kInterSemiBold[];
extern const unsigned int kInterSemiBold_size;

}  // namespace substep
