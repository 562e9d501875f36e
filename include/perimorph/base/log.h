#pragma once

#include <mpi.h>

#include <iostream>
#include <memory>
#include <string>
#include <vector>

namespace Perimorph::Base
{
  /// Everything a run tells its user: rank 0 writes to the console and, once
  /// open() was called, to a file as well; other ranks are silent. Every line
  /// is flushed when it ends, so a killed run leaves a complete log.
  class Log
  {
  public:
    /// @param console   where rank 0 of @p communicator writes
    explicit Log(MPI_Comm      communicator = MPI_COMM_WORLD,
                 std::ostream &console      = std::cout);

    ~Log();

    Log(const Log &) = delete;
    Log &
    operator=(const Log &) = delete;

    /// Writes to @p filename from now on; what was said before comes first.
    /// @param append   behind what an earlier run left there
    /// @throws InputError   rank 0 only: the file cannot be written
    void
    open(const std::string &filename, bool append = false);

    /// Prints @p text at once as "Warning: text" on a line of its own and
    /// keeps it for the summary. A text that was said before is dropped. To
    /// be called on every rank; what only other ranks say is lost.
    void
    warning(const std::string &text);

    /// All warnings so far, in the order they came.
    const std::vector<std::string> &
    warnings() const;

    /// True on the rank that prints: false means that work done only to be
    /// printed can be saved.
    bool
    is_active() const;

    /// The stream behind operator<<, for functions that fill a std::ostream.
    std::ostream &
    stream();

    template <typename T>
    Log &
    operator<<(const T &value)
    {
      if (active)
        stream() << value;
      return *this;
    }

    /// Manipulators: std::endl, std::flush, std::setprecision...
    Log &
    operator<<(std::ostream &(*manipulator)(std::ostream &));

  private:
    class Tee;

    const bool               active;
    std::unique_ptr<Tee>     tee;
    std::ostream             output;
    std::vector<std::string> warning_list;
  };
} // namespace Perimorph::Base
