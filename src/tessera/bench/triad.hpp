#pragma once

namespace tessera {

/// Bandwidth of a[i] = b[i] + s c[i] on arrays far larger than the caches, with the present number of threads
/// [bytes/s]: three streams and the reading of the written lines, 32 bytes an element. The best of a few sweeps.
double triad_bandwidth();

}  // namespace tessera
