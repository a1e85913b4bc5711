#include "candela/bake/fourier.hpp"

#include <cmath>

namespace candela::bake {
namespace {

using Complex = std::complex<double>;

// The operator of std::complex looks for infinities.
Complex product(const Complex& a, const Complex& b) {
    return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

}  // namespace

Fourier::Fourier(std::size_t length) : roots_(length) {
    for (std::size_t i = 0; i < length; ++i) {
        const double angle = -2.0 * M_PI * static_cast<double>(i) / static_cast<double>(length);
        roots_[i] = {std::cos(angle), std::sin(angle)};
    }
    std::size_t rest = length;
    while (rest % 4 == 0) {
        factors_.push_back(4);
        rest /= 4;
    }
    for (std::size_t prime = 2; rest > 1; ++prime) {
        while (rest % prime == 0) {
            factors_.push_back(prime);
            rest /= prime;
        }
    }
}

void Fourier::forward(const Complex* in, Complex* out) const {
    step(in, 1, out, length(), 0);
}

// Cooley & Tukey 1965, decimation in time.
void Fourier::step(const Complex* in, std::size_t stride, Complex* out, std::size_t length,
                   std::size_t factor) const {
    if (length == 1) {
        out[0] = in[0];
        return;
    }
    const std::size_t parts = factors_[factor];
    const std::size_t part = length / parts;
    for (std::size_t q = 0; q < parts; ++q)
        step(in + q * stride, stride * parts, out + q * part, part, factor + 1);
    if (parts == 4) {
        for (std::size_t k = 0; k < part; ++k) {
            const Complex a = out[k];
            const Complex b = product(out[k + part], roots_[k * stride]);
            const Complex c = product(out[k + 2 * part], roots_[2 * k * stride]);
            const Complex d = product(out[k + 3 * part], roots_[3 * k * stride]);
            const Complex even = a + c;
            const Complex odd = a - c;
            const Complex both = b + d;
            const Complex turned(b.imag() - d.imag(), d.real() - b.real());
            out[k] = even + both;
            out[k + part] = odd + turned;
            out[k + 2 * part] = even - both;
            out[k + 3 * part] = odd - turned;
        }
        return;
    }
    if (parts == 2) {
        for (std::size_t k = 0; k < part; ++k) {
            const Complex a = out[k];
            const Complex b = product(out[k + part], roots_[k * stride]);
            out[k] = a + b;
            out[k + part] = a - b;
        }
        return;
    }
    std::vector<Complex> terms(parts);
    for (std::size_t k = 0; k < part; ++k) {
        for (std::size_t q = 0; q < parts; ++q) terms[q] = product(out[k + q * part], roots_[q * k * stride]);
        for (std::size_t j = 0; j < parts; ++j) {
            Complex sum = terms[0];
            for (std::size_t q = 1; q < parts; ++q)
                sum += product(terms[q], roots_[(q * j * part * stride) % roots_.size()]);
            out[k + j * part] = sum;
        }
    }
}

}  // namespace candela::bake
