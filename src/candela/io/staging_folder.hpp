#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace candela::io::detail {

/// Several files that appear together: they are written into a temporary folder inside the one they are for,
/// and moved out of it by commit(). Without a commit nothing is left, nor the folder where it was not there
/// before.
class StagingFolder {
  public:
    /// Makes `folder` when it is missing, as output_folder.hpp has it. Throws Error.
    explicit StagingFolder(const std::filesystem::path& folder);
    StagingFolder(const StagingFolder&) = delete;
    StagingFolder& operator=(const StagingFolder&) = delete;
    ~StagingFolder();

    /// Where to write the file that will have this name.
    [[nodiscard]] std::filesystem::path file(const std::string& name);

    /// Moves the files into place in the order of file(); returns where they are. Throws Error after taking
    /// back what it had moved to names that were free.
    std::vector<std::filesystem::path> commit();

  private:
    std::filesystem::path folder_;
    std::filesystem::path temporary_;
    std::filesystem::path made_;  ///< the folder, when it was not there before
    std::vector<std::string> names_;
    bool committed_ = false;
};

}  // namespace candela::io::detail
