/// Errors people meet: what happened, where, and the remedy, in one line.
#pragma once

#include <stdexcept>
#include <string>

namespace tessera {

/// The program's exit status: design contract of the command line.
enum class ExitStatus : int { good = 0, run_failed = 1, bad_input = 2 };

/// Base of every error shown to a user; what() is "what, where, remedy" on one line (empty parts left out).
class Error : public std::runtime_error {
 public:
  Error(ExitStatus status, const std::string& what, const std::string& where, const std::string& remedy);
  ExitStatus status() const { return status_; }

 private:
  ExitStatus status_;
};

/// The case, a file or an argument is wrong: found before any work is done where possible. Exit status 2.
class InputError : public Error {
 public:
  InputError(const std::string& what, const std::string& where, const std::string& remedy)
      : Error(ExitStatus::bad_input, what, where, remedy) {}
};

/// A run that began well failed: blow-up, disk full, interruption. Exit status 1.
class RunError : public Error {
 public:
  RunError(const std::string& what, const std::string& where, const std::string& remedy)
      : Error(ExitStatus::run_failed, what, where, remedy) {}
};

/// User-level check: throws InputError unless condition holds (bugs are assert's business, not this one's).
inline void require(bool condition, const std::string& what, const std::string& where,
                    const std::string& remedy) {
  if (!condition)
    throw InputError(what, where, remedy);
}

} // namespace tessera
