#include "candela/io/staging_folder.hpp"

#include <unistd.h>

#include "candela/io/output_folder.hpp"
#include "candela/scene/error.hpp"

namespace candela::io::detail {

namespace fs = std::filesystem;

StagingFolder::StagingFolder(const fs::path& folder) : folder_(folder.empty() ? "." : folder) {
    std::error_code failure;
    if (!folder_.has_filename() && folder_.has_parent_path()) folder_ = folder_.parent_path();
    if (make_output_folder(folder_)) made_ = folder_;
    constexpr int most_attempts = 1000;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
        temporary_ =
            folder_ / (".candela-" + std::to_string(getpid()) + "-" + std::to_string(attempt) + ".part");
        if (fs::create_directory(temporary_, failure)) return;
        if (failure) break;
    }
    const Error error =
        folder_error(failure ? failure : std::make_error_code(std::errc::file_exists), folder_);
    temporary_.clear();
    if (!made_.empty()) fs::remove_all(made_, failure);
    throw error;
}

StagingFolder::~StagingFolder() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
    if (!committed_ && !made_.empty()) fs::remove_all(made_, ignored);
}

fs::path StagingFolder::file(const std::string& name) {
    names_.push_back(name);
    return temporary_ / name;
}

std::vector<fs::path> StagingFolder::commit() {
    std::vector<fs::path> done, fresh;
    for (const std::string& name : names_) {
        const fs::path target = folder_ / name;
        std::error_code failure;
        const bool was_there = fs::exists(fs::symlink_status(target));
        fs::rename(temporary_ / name, target, failure);
        if (failure) {
            std::error_code ignored;
            for (const fs::path& file : fresh) fs::remove(file, ignored);
            throw Error(Fault::input, "cannot be written: " + failure.message(), target.string());
        }
        done.push_back(target);
        if (!was_there) fresh.push_back(target);
    }
    committed_ = true;
    return done;
}

}  // namespace candela::io::detail
