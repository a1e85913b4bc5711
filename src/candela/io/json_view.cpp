#include <algorithm>
#include <cctype>
#include <cmath>

#include "candela/io/gltf_document.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

bool same_letters(const std::string& a, const std::string& b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [&](char x, char y) { return lower(x) == lower(y); });
}

}  // namespace

void JsonView::fail(const std::string& what, const std::string& hint) const {
    throw input_error(what, where_, hint);
}

void JsonView::repaired(const std::string& what) const {
    constexpr std::size_t longest = 40;
    std::string place = where_;
    if (value_ && value_->is_primitive()) {
        const std::string value = value_->dump(-1, ' ', false, json::error_handler_t::replace);
        if (value.size() <= longest) place += " = " + value;
    }
    warnings_->warn_at(place, what);
}

JsonView JsonView::operator[](const char* key) const {
    const std::string at = where_ + "/" + key;
    if (!value_) return {nullptr, at, warnings_};
    if (!value_->is_object()) {
        repaired("must be an object: read as absent");
        return {nullptr, at, warnings_};
    }
    const auto found = value_->find(key);
    if (found == value_->end()) return {nullptr, at, warnings_};
    if (found->is_null()) {
        warnings_->warn_at(at, "is null: read as absent");
        return {nullptr, at, warnings_};
    }
    return {&*found, at, warnings_};
}

JsonView JsonView::operator[](std::size_t index) const {
    if (index >= size())
        fail("index " + std::to_string(index) + " is out of range: it has " + std::to_string(size()));
    return {&(*value_)[index], where_ + "/" + std::to_string(index), warnings_};
}

bool JsonView::is_array() const {
    return value_ && value_->is_array();
}

bool JsonView::is_negative() const {
    return value_ && value_->is_number() && value_->get<double>() < 0.0;
}

std::size_t JsonView::size() const {
    if (!value_) return 0;
    if (value_->is_array()) return value_->size();
    repaired("must be an array: read as absent");
    return 0;
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
    if (value_->is_string()) return value_->get<std::string>();
    repaired("must be a string: read as absent");
    return fallback;
}

std::string JsonView::one_of(std::initializer_list<const char*> names, bool optional) const {
    const std::string fallback = *names.begin();
    if (!value_ && optional) return fallback;
    const std::string text = string_or("");
    for (const char* name : names) {
        if (text == name) return text;
    }
    for (const char* name : names) {
        if (!same_letters(text, name)) continue;
        repaired(std::string("is written ") + name + " in glTF: read so");
        return name;
    }
    std::string known;
    for (const char* name : names) known += (known.empty() ? "" : ", ") + std::string(name);
    if (!optional) {
        repaired("is none of " + known + ": skipped");
        return "";
    }
    repaired("is none of " + known + ": read as " + fallback);
    return fallback;
}

bool JsonView::bool_or(bool fallback) const {
    if (!value_) return fallback;
    if (value_->is_boolean()) return value_->get<bool>();
    if (value_->is_number()) {
        repaired("must be true or false: 0 is read as false, other numbers as true");
        return value_->get<double>() != 0.0;
    }
    repaired("must be true or false: read as absent");
    return fallback;
}

bool JsonView::has_true(const char* key) const noexcept {
    if (!value_ || !value_->is_object()) return false;
    const auto found = value_->find(key);
    return found != value_->end() && found->is_boolean() && found->get<bool>();
}

float JsonView::float_or(float fallback) const {
    if (!value_) return fallback;
    if (!value_->is_number()) {
        repaired("must be a number: read as absent");
        return fallback;
    }
    const auto number = static_cast<float>(value_->get<double>());
    if (std::isfinite(number)) return number;
    repaired("must be a finite number: read as absent");
    return fallback;
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

std::optional<std::uint64_t> JsonView::optional_unsigned() const {
    if (!value_) return std::nullopt;
    try {
        return unsigned_integer();
    } catch (const Error& error) {
        repaired(std::string(error.what()) + ": read as absent");
        return std::nullopt;
    }
}

std::optional<std::uint32_t> JsonView::index_below(std::size_t count) const {
    const std::optional<std::uint64_t> index = optional_unsigned();
    if (!index) return std::nullopt;
    if (*index < count) return static_cast<std::uint32_t>(*index);
    repaired("is out of range (there are " + std::to_string(count) + "): read as absent");
    return std::nullopt;
}

std::optional<std::uint32_t> JsonView::strict_index_below(std::size_t count) const {
    const std::optional<std::uint64_t> index = unsigned_integer();
    if (!index) return std::nullopt;
    if (*index >= count)
        fail("index " + std::to_string(*index) + " is out of range: there are " + std::to_string(count));
    return static_cast<std::uint32_t>(*index);
}

std::uint32_t JsonView::required_index_below(std::size_t count) const {
    const std::optional<std::uint32_t> index = strict_index_below(count);
    if (!index) fail("is missing");
    return *index;
}

bool JsonView::doubles(std::span<double> out) const {
    if (!value_) return false;
    const bool numbers =
        value_->is_array() && value_->size() >= out.size() &&
        std::all_of(value_->begin(), value_->end(), [](const json& element) {
            // What is stored later must be finite as a float too.
            return element.is_number() && std::isfinite(static_cast<float>(element.get<double>()));
        });
    if (!numbers) {
        repaired("must be an array of " + std::to_string(out.size()) + " finite numbers: read as absent");
        return false;
    }
    if (value_->size() > out.size())
        repaired("must be an array of " + std::to_string(out.size()) +
                 " numbers: the further ones are not read");
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = (*value_)[i].get<double>();
    return true;
}

bool JsonView::floats(std::span<float> out) const {
    std::vector<double> numbers(out.size());
    if (!doubles(numbers)) return false;
    std::transform(numbers.begin(), numbers.end(), out.begin(), [](double x) { return float(x); });
    return true;
}

void JsonView::leading_floats(std::span<float> out) const {
    if (!value_ || !value_->is_array() || value_->empty() || value_->size() >= out.size()) {
        floats(out);
        return;
    }
    repaired("must be an array of " + std::to_string(out.size()) +
             " numbers: the missing ones are the default");
    for (std::size_t i = 0; i < value_->size(); ++i) out[i] = (*this)[i].float_or(out[i]);
}

}  // namespace candela::io
