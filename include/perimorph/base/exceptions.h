#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace Perimorph::Base
{
  /// The four facts of a message about bad input; empty ones are left out.
  struct InputMessage
  {
    /// which entry or entity, e.g. "parameter 'Material / law'"
    std::string where;
    /// what was found there
    std::string found;
    /// what is allowed
    std::string allowed;
    /// nearest valid name, usual value or advice: a whole sentence
    std::string hint;

    /// "where\n  found ...; allowed: .... hint" (no "Error:" in front).
    std::string
    text() const;
  };

  /// Bad input (exit code 2), with one or several complete messages.
  /// what() is ready to print: every message behind "Error: ", one below
  /// the other.
  class InputError : public std::runtime_error
  {
  public:
    explicit InputError(const std::string &message);
    explicit InputError(const InputMessage &message);
    explicit InputError(const std::vector<std::string> &messages);

    const std::vector<std::string> &
    messages() const;

  private:
    std::vector<std::string> message_list;
  };

  /// The solve failed (exit code 3): say the step, the residual history and
  /// the last state saved.
  class SolveError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /// A deformation that no law can answer (J = det F <= 0, no stress-free
  /// thickness): Newton may shorten its step on it.
  class InadmissibleState : public SolveError
  {
  public:
    using SolveError::SolveError;
  };

  /// Gathers the messages of all checks, so that a user sees them at once.
  class InputErrorCollector
  {
  public:
    void
    add(const std::string &message);

    void
    add(const InputMessage &message);

    /// Message about the parameter @p path ("Section / entry"); says
    /// "parameter '<path>' in <origin>" if the origin was remembered.
    void
    add_parameter(const std::string &path,
                  const std::string &found,
                  const std::string &allowed,
                  const std::string &hint = "");

    /// Remembers where a parameter was set, e.g. "plate.prm:12" or "--set".
    void
    remember_origin(const std::string &path, const std::string &origin);

    /// Runs a check that throws and keeps its messages, so that the next check
    /// runs too.
    /// @param where   put in front of each message; may be empty
    void
    collect(const std::function<void()> &check, const std::string &where = "");

    bool
    empty() const;

    std::size_t
    size() const;

    const std::vector<std::string> &
    messages() const;

    /// @throws InputError   with all messages, if there is at least one
    void
    throw_if_any() const;

  private:
    std::vector<std::string>           message_list;
    std::map<std::string, std::string> origins;
  };
} // namespace Perimorph::Base
