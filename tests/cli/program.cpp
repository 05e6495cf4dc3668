#include "tests/cli/program.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace tessera::cli {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

} // namespace

void Workplace::write(const std::string& name, const std::string& text) const {
  fs::create_directories((path() / name).parent_path());
  std::ofstream(path() / name, std::ios::binary) << text;
}

std::string Workplace::read(const std::string& name) const {
  return read_file(path() / name);
}

std::vector<std::string> Workplace::listing() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path()))
    names.push_back(fs::relative(entry.path(), path()).string());
  std::sort(names.begin(), names.end());
  return names;
}

pid_t Workplace::start(const std::vector<std::string>& arguments, const Surroundings& surroundings) const {
  const std::string program = std::string(TESSERA_BIN_DIR) + "/tessera";
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments)
    argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const std::string out =
      surroundings.out_file.empty() ? (outputs_.path() / "out").string() : surroundings.out_file;
  const std::string err = (outputs_.path() / "err").string();

  const pid_t child = ::fork();
  if (child < 0)
    throw std::runtime_error("cannot fork");
  if (child > 0)
    return child;
  // Only what is safe between fork and exec.
  const auto redirect = [](const char* file, int flags, int to) {
    const int from = ::open(file, flags, 0600);
    if (from < 0 || ::dup2(from, to) < 0)
      ::_exit(120);
  };
  redirect("/dev/null", O_RDONLY, STDIN_FILENO);
  redirect(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  redirect(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  if (::chdir(path().c_str()) != 0)
    ::_exit(121);
  if (!surroundings.pictures)
    ::setenv("PATH", "/nonexistent", 1);
  ::setenv("OMP_WAIT_POLICY", "passive", 1); // tests share the machine
  if (surroundings.largest_file > 0) {
    const rlimit limit{surroundings.largest_file, surroundings.largest_file};
    if (::setrlimit(RLIMIT_FSIZE, &limit) != 0)
      ::_exit(122);
  }
  ::execv(program.c_str(), argv.data());
  ::_exit(123);
}

Result Workplace::wait(pid_t process) const {
  int status = 0;
  if (::waitpid(process, &status, 0) != process)
    throw std::runtime_error("cannot wait");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status),
          read_file(outputs_.path() / "out"), read_file(outputs_.path() / "err")};
}

Result Workplace::tessera(const std::vector<std::string>& arguments, const Surroundings& surroundings) const {
  return wait(start(arguments, surroundings));
}

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> all;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    all.push_back(line);
  return all;
}

} // namespace tessera::cli
