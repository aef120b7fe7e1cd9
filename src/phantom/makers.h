// The phantoms themselves, one function each; options are already checked and `size` is set.
#pragma once

#include "isoatlas/phantom.h"

namespace isoatlas {

/// The dissertation's figure 3.10/12.1 as 24^3 uint8 boxes. Answer: 14 events (docs/theory/3-trees.md#the-example): maxima 100 90 80 70,
/// 60 merge, 58 and 56 genus, 50 merge, 48 and 46 genus, 40 merge, 38 genus, 30 complex (torus -> two spheres), 20 minimum.
Volume figure_plateau();

/// The same object as a 32^3 float32 field of distinct values: 15 events, because 30 becomes 30.0 genus (front wall closes)
/// and 29.5 split (back wall closes); a grid element cannot turn a torus into two spheres.
Volume figure_smooth();

/// `genus` round tori in a row along x, neighbours touching. Value 1 - distance to the nearest circle / (0.15 size).
/// Answer: for tau in [0.3, 0.7] one object of genus `genus`, without cavities. float32.
Volume torus_chain(const PhantomOptions& options);

/// `shells` concentric spherical shells. Answer: at tau 0.5 there are `shells` objects, each with one cavity, no tunnel,
/// and 2 * shells contours, all spheres. float32.
Volume nested_shells(const PhantomOptions& options);

/// The scene of `make demo`. A ball (180) with a hollow crust hidden inside (250, cavity 60), a second ball (220) joined to it by a neck
/// (160), and a ring with one tunnel (200) that hangs on the second by a thin bridge (90); soft flanks, background 0. float32, 0.5 mm.
/// Answer: 7 events. Maxima 250 (hollow: one cavity), 220, 200 (a ring); merges at 160 and 90; the cavity fills at 60; the ring's tunnel
/// and everything else at 0.
Volume demo(const PhantomOptions& options);

/// Marschner and Lobb's test signal (1994), frequency 6, alpha 0.25, on [-1, 1]^3. float32, values in [0, 1].
/// Answer: values fall strictly along z, so every critical voxel lies in the first or last slice.
Volume marschner_lobb(const PhantomOptions& options);

/// sin x cos y + sin y cos z + sin z cos x, two periods a side. float32.
/// Answer: a point reflection about the middle negates every sample; at tau 0 High and Low are congruent labyrinths.
Volume gyroid(const PhantomOptions& options);

/// 1 where x + y + z is even, else 0. uint8. Every face is ambiguous with value 1/2.
/// Answer: above 1/2 every one is an object of its own: ceil(n^3 / 2); at 1/2 there is one object with
/// chi = ceil(n^3 / 2) - 3 n (n-1)^2 + 3 (n-1)^3.
Volume checkerboard(const PhantomOptions& options);

/// Sum of 60 cosines with random directions and phases, 2 to 10 periods a side. float32. Answer: the same bytes for the same seed.
Volume random_field(const PhantomOptions& options);

/// Independent uniform values in [0, 1). float32. Answer: the same bytes for the same seed.
Volume noise(const PhantomOptions& options);

}  // namespace isoatlas
