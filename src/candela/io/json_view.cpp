#include <cmath>

#include "candela/io/gltf_document.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {

void JsonView::fail(const std::string& what, const std::string& hint) const {
    throw input_error(what, where_, hint);
}

JsonView JsonView::operator[](const char* key) const {
    const std::string at = where_ + "/" + key;
    if (!value_) return {nullptr, at};
    if (!value_->is_object()) fail("must be an object");
    const auto found = value_->find(key);
    return {found == value_->end() ? nullptr : &*found, at};
}

JsonView JsonView::operator[](std::size_t index) const {
    if (index >= size())
        fail("index " + std::to_string(index) + " is out of range: it has " + std::to_string(size()));
    return {&(*value_)[index], where_ + "/" + std::to_string(index)};
}

std::size_t JsonView::size() const {
    if (!value_) return 0;
    if (!value_->is_array()) fail("must be an array");
    return value_->size();
}

std::vector<std::string> JsonView::keys() const {
    std::vector<std::string> out;
    if (!value_) return out;
    if (!value_->is_object()) fail("must be an object");
    for (const auto& [key, value] : value_->items()) out.push_back(key);
    return out;
}

std::string JsonView::string_or(const std::string& fallback) const {
    if (!value_) return fallback;
    if (!value_->is_string()) fail("must be a string");
    return value_->get<std::string>();
}

bool JsonView::bool_or(bool fallback) const {
    if (!value_) return fallback;
    if (!value_->is_boolean()) fail("must be true or false");
    return value_->get<bool>();
}

float JsonView::float_or(float fallback) const {
    if (!value_) return fallback;
    if (!value_->is_number()) fail("must be a number");
    const auto number = static_cast<float>(value_->get<double>());
    if (!std::isfinite(number)) fail("must be a finite number");
    return number;
}

std::optional<std::uint64_t> JsonView::unsigned_integer() const {
    if (!value_) return std::nullopt;
    if (value_->is_number_unsigned()) return value_->get<std::uint64_t>();
    // Some exporters write whole numbers with a decimal point.
    if (value_->is_number_float()) {
        const double x = value_->get<double>();
        if (x >= 0.0 && x < 9e15 && std::floor(x) == x) return static_cast<std::uint64_t>(x);
    }
    fail("must be a whole number of 0 or more");
}

std::uint64_t JsonView::unsigned_or(std::uint64_t fallback) const {
    return unsigned_integer().value_or(fallback);
}

std::optional<std::uint32_t> JsonView::index_below(std::size_t count) const {
    const std::optional<std::uint64_t> index = unsigned_integer();
    if (!index) return std::nullopt;
    if (*index >= count)
        fail("index " + std::to_string(*index) + " is out of range: there are " + std::to_string(count));
    return static_cast<std::uint32_t>(*index);
}

std::uint32_t JsonView::required_index_below(std::size_t count) const {
    const std::optional<std::uint32_t> index = index_below(count);
    if (!index) fail("is missing");
    return *index;
}

bool JsonView::doubles(std::span<double> out) const {
    if (!value_) return false;
    if (!value_->is_array() || value_->size() != out.size()) {
        fail("must be an array of " + std::to_string(out.size()) + " numbers");
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        const JsonView number = (*this)[i];
        // Range and type as for a float: what is stored later must be finite there too.
        (void)number.float_or(0.0f);
        out[i] = number.value_->get<double>();
    }
    return true;
}

bool JsonView::floats(std::span<float> out) const {
    if (!value_) return false;
    if (!value_->is_array() || value_->size() != out.size()) {
        fail("must be an array of " + std::to_string(out.size()) + " numbers");
    }
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = (*this)[i].float_or(0.0f);
    return true;
}

}  // namespace candela::io
