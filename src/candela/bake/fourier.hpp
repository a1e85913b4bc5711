#pragma once

#include <complex>
#include <cstddef>
#include <vector>

namespace candela::bake {

/// The discrete Fourier transform of one length, any product of small primes being quick.
class Fourier {
  public:
    explicit Fourier(std::size_t length);

    [[nodiscard]] std::size_t length() const noexcept { return roots_.size(); }

    /// out[k] = sum over j of in[j] exp(-2 pi i j k / length). `in` and `out` must not overlap.
    void forward(const std::complex<double>* in, std::complex<double>* out) const;

  private:
    void step(const std::complex<double>* in, std::size_t stride, std::complex<double>* out,
              std::size_t length, std::size_t factor) const;

    std::vector<std::size_t> factors_;
    std::vector<std::complex<double>> roots_;
};

}  // namespace candela::bake
