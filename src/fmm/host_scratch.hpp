#pragma once

#include <skein/core/simd.hpp>

#include <cstddef>
#include <new>

namespace skein {

/// Memory of one task of a host kernel, aligned for packs, not initialized.
template <class Real>
class HostScratch {
 public:
  explicit HostScratch(const int n)
      : start_(static_cast<Real*>(
            ::operator new(static_cast<std::size_t>(n) * sizeof(Real), std::align_val_t(simd::bytes)))) {}
  ~HostScratch() { ::operator delete(start_, std::align_val_t(simd::bytes)); }
  HostScratch(const HostScratch&) = delete;
  HostScratch& operator=(const HostScratch&) = delete;

  Real* data() const { return start_; }

 private:
  Real* start_;
};

}  // namespace skein
