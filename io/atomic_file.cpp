#include "io/atomic_file.hpp"

#include "core/error.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

#include <fcntl.h>
#include <unistd.h>

namespace tessera::io {
namespace {

namespace fs = std::filesystem;

/// An open descriptor, closed at the end of the scope.
class Descriptor {
 public:
  Descriptor(const fs::path& file, int flags) : value_(::open(file.c_str(), flags | O_CLOEXEC, 0666)) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0)
      ::close(value_);
  }
  /// Closes now and says whether that worked: network file systems report a full disk only here.
  bool close() {
    const int result = ::close(value_);
    value_ = -1;
    return result == 0;
  }
  int value() const { return value_; }
  bool good() const { return value_ >= 0; }

 private:
  int value_;
};

[[noreturn]] void fail(const fs::path& file, int reason) {
  const bool full = reason == ENOSPC || reason == EDQUOT || reason == EFBIG;
  throw RunError(fmt::format("cannot write: {}", std::strerror(reason)), file.string(),
                 full ? "free some space or choose another output folder with -o"
                      : "check the folder's permissions or choose another output folder with -o");
}

/// Hidden, unique to this process and call, in the same folder (rename works within one file system only) and
/// with the same extension (writers choose formats by it).
fs::path temporary_of(const fs::path& file) {
  static std::atomic<int> count = 0;
  return file.parent_path() /
         fmt::format(".{}.tmp-{}-{}{}", file.stem().string(), ::getpid(), count++, file.extension().string());
}

/// Removes the temporary unless the rename has happened.
struct Cleanup {
  fs::path file;
  ~Cleanup() {
    if (!file.empty())
      ::unlink(file.c_str());
  }
};

void synchronise(const fs::path& temporary, const fs::path& file) {
  Descriptor opened(temporary, O_RDONLY);
  if (!opened.good() || ::fsync(opened.value()) != 0)
    fail(file, errno);
}

void rename_into_place(const fs::path& temporary, const fs::path& file) {
  if (::rename(temporary.c_str(), file.c_str()) != 0)
    fail(file, errno);
  // The name itself survives a power cut only once its folder is on disk; some file systems cannot do that,
  // and the content is safe by then, so a refusal is not an error.
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const Descriptor opened(folder, O_RDONLY | O_DIRECTORY);
  if (opened.good())
    ::fsync(opened.value());
}

} // namespace

void write_text(const fs::path& file, std::string_view content) {
  Cleanup temporary{temporary_of(file)};
  Descriptor out(temporary.file, O_WRONLY | O_CREAT | O_EXCL);
  if (!out.good()) {
    const int reason = errno;
    temporary.file.clear();
    fail(file, reason);
  }
  while (!content.empty()) {
    const ssize_t written = ::write(out.value(), content.data(), content.size());
    if (written < 0 && errno == EINTR)
      continue;
    if (written < 0)
      fail(file, errno);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(out.value()) != 0)
    fail(file, errno);
  if (!out.close())
    fail(file, errno);
  rename_into_place(temporary.file, file);
  temporary.file.clear();
}

void write_atomically(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  Cleanup temporary{temporary_of(file)};
  write(temporary.file);
  std::error_code error;
  const auto size = fs::file_size(temporary.file, error);
  if (error)
    fail(file, error.value());
  if (size == 0)
    throw RunError("cannot write: nothing arrived in the file", file.string(),
                   "check that the disk is not full");
  synchronise(temporary.file, file);
  rename_into_place(temporary.file, file);
  temporary.file.clear();
}

void make_output_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  // create_directories reports an existing file of that name in no uniform way.
  if (!error && !fs::is_directory(folder))
    error = std::make_error_code(std::errc::not_a_directory);
  require(!error, fmt::format("cannot create the output folder: {}", error.message()), folder.string(),
          "choose another one with -o");
  const Cleanup proof{temporary_of(folder / "proof")};
  Descriptor out(proof.file, O_WRONLY | O_CREAT | O_EXCL);
  const bool written = out.good() && ::write(out.value(), "x", 1) == 1 && out.close();
  require(written, fmt::format("cannot write in the output folder: {}", std::strerror(errno)),
          folder.string(), "choose another one with -o");
}

} // namespace tessera::io
