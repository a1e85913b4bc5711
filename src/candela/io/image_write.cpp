#include "candela/io/image_write.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "candela/io/image_write_safe.hpp"
#include "candela/scene/error.hpp"

namespace candela::io {
namespace {

namespace fs = std::filesystem;

/// Whose fault a failed system call is: the request's where another name would help, else the machine's.
Error write_error(int code, const fs::path& file) {
    const bool request = code == ENOENT || code == ENOTDIR || code == EACCES || code == EPERM ||
                         code == EROFS || code == ENAMETOOLONG || code == EISDIR || code == EINVAL;
    const Fault fault = request ? Fault::input : Fault::machine;
    // Not of every file system: in some that are there no file can be made.
    std::error_code ignored;
    if (code == ENOTDIR ||
        (code == ENOENT && !fs::is_directory(fs::absolute(file, ignored).parent_path(), ignored)))
        return {fault, "the folder does not exist", file.string(), "make it first"};
    return {fault, std::string("cannot be written: ") + std::strerror(code), file.string()};
}

constexpr int most_links = 40;  // as the kernel follows

/// What a symbolic link points to, which need not exist yet.
fs::path followed(const fs::path& file) {
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    if (status.type() == fs::file_type::directory) throw input_error("is a folder", file.string());
    if (fs::exists(status) && status.type() != fs::file_type::regular) {
        throw input_error("is not a regular file", file.string(),
                          "pictures are written to a temporary name and renamed");
    }
    fs::path target = file;
    for (int links = 0; fs::is_symlink(fs::symlink_status(target, failure)); ++links) {
        if (links == most_links) throw write_error(ELOOP, file);
        // An absolute link replaces the folder; canonical() would refuse a link to what is not there yet.
        target = target.parent_path() / fs::read_symlink(target, failure);
    }
    return target;
}

/// A short name, because the name that was asked for may be as long as the file system allows.
fs::path temporary_name(const fs::path& target, int attempt) {
    return target.parent_path() /
           (".candela-" + std::to_string(getpid()) + "-" + std::to_string(attempt) + ".part");
}

}  // namespace

namespace detail {

SafeFile::SafeFile(const fs::path& file) : asked_(file), target_(followed(file)) {
    if (target_.filename().empty()) throw input_error("a file name is missing", file.string());
    constexpr int most_attempts = 1000;
    for (int attempt = 0; !stream_; ++attempt) {
        temporary_ = temporary_name(target_, attempt);
        // umask decides the permissions, as for any file that a program creates.
        const int descriptor = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor < 0 && errno == EEXIST && attempt < most_attempts) continue;
        if (descriptor < 0) throw write_error(errno, asked_);
        stream_.reset(::fdopen(descriptor, "wb"));
        if (stream_) return;
        failure_ = errno;
        ::close(descriptor);
        ::unlink(temporary_.c_str());
        throw write_error(failure_, asked_);
    }
}

SafeFile::~SafeFile() {
    stream_.reset();
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool SafeFile::note_failure() noexcept {
    if (failure_ == 0) failure_ = errno != 0 ? errno : EIO;
    return false;
}

bool SafeFile::write(const void* bytes, std::size_t count) noexcept {
    if (failure_ != 0) return false;
    return std::fwrite(bytes, 1, count, stream_.get()) == count || note_failure();
}

bool SafeFile::seek(std::uint64_t position) noexcept {
    if (failure_ != 0) return false;
    return ::fseeko(stream_.get(), static_cast<off_t>(position), SEEK_SET) == 0 || note_failure();
}

std::uint64_t SafeFile::position() const noexcept {
    return static_cast<std::uint64_t>(::ftello(stream_.get()));
}

void SafeFile::check() const {
    if (failure_ != 0) throw write_error(failure_, asked_);
}

void SafeFile::commit() {
    // Renaming may reach the disk before the data does; after a power cut there would be an empty picture.
    // Some file systems cannot sync and say EINVAL.
    if (failure_ == 0 && std::fflush(stream_.get()) != 0) (void)note_failure();
    if (failure_ == 0 && ::fsync(fileno(stream_.get())) != 0 && errno != EINVAL) (void)note_failure();
    if (std::fclose(stream_.release()) != 0 && failure_ == 0) (void)note_failure();
    if (failure_ == 0 && std::rename(temporary_.c_str(), target_.c_str()) != 0) (void)note_failure();
    check();
    temporary_.clear();
}

}  // namespace detail

void write_file(const fs::path& file, std::span<const std::byte> bytes) {
    detail::SafeFile out(file);
    (void)out.write(bytes.data(), bytes.size());
    out.commit();
}

}  // namespace candela::io
