#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <span>

namespace candela::io::detail {

/// A file that appears under its name only when it is whole: written under a temporary name in the same
/// folder and renamed by commit(); without a commit nothing is left. A symbolic link is followed, so that
/// what it points to is replaced and not the link.
class SafeFile {
  public:
    /// Throws Error: Fault::input when the folder is missing or not writable or `file` is not a regular file,
    /// Fault::machine when the disk fails.
    explicit SafeFile(const std::filesystem::path& file);
    SafeFile(const SafeFile&) = delete;
    SafeFile& operator=(const SafeFile&) = delete;
    ~SafeFile();

    /// False once writing has failed; check() and commit() then say why. Never throws, for use from C
    /// callbacks.
    [[nodiscard]] bool write(const void* bytes, std::size_t count) noexcept;
    [[nodiscard]] bool seek(std::uint64_t position) noexcept;
    [[nodiscard]] std::uint64_t position() const noexcept;

    /// Throws Error for the first failure, if there was one.
    void check() const;

    /// Flushes to the disk and renames. Throws Error (Fault::machine).
    void commit();

  private:
    struct Close {
        void operator()(std::FILE* f) const noexcept { std::fclose(f); }
    };
    [[nodiscard]] bool note_failure() noexcept;

    std::filesystem::path asked_;
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    std::unique_ptr<std::FILE, Close> stream_;
    int failure_ = 0;  ///< errno of the first failure
};

}  // namespace candela::io::detail
