#include <perimorph/base/exceptions.h>
#include <perimorph/base/log.h>

#include <algorithm>
#include <fstream>
#include <streambuf>

namespace Perimorph::Base
{
  namespace
  {
    bool
    is_root(MPI_Comm communicator)
    {
      int initialized = 0;
      MPI_Initialized(&initialized);
      int rank = 0;
      if (initialized != 0)
        MPI_Comm_rank(communicator, &rank);
      return rank == 0;
    }
  } // namespace


  /// A stream buffer that hands each character on to console and file. Until
  /// there is a file it remembers what the file is owed.
  class Log::Tee : public std::streambuf
  {
  public:
    explicit Tee(std::ostream &console)
      : console(console)
    {}

    bool
    open(const std::string &filename, const bool append)
    {
      file.close();
      file.clear();
      file.open(filename, append ? std::ios::app : std::ios::out);
      file << owed << std::flush;
      owed.clear();
      return file.good();
    }

    bool at_line_start = true;

  protected:
    int_type
    overflow(const int_type character) override
    {
      if (traits_type::eq_int_type(character, traits_type::eof()))
        return traits_type::not_eof(character);
      const char single = traits_type::to_char_type(character);
      xsputn(&single, 1);
      return character;
    }

    std::streamsize
    xsputn(const char *text, const std::streamsize length) override
    {
      if (length <= 0)
        return 0;
      console.write(text, length);
      if (file.is_open())
        file.write(text, length);
      else
        owed.append(text, length);
      at_line_start = (text[length - 1] == '\n');
      if (std::find(text, text + length, '\n') != text + length)
        sync();
      return length;
    }

    int
    sync() override
    {
      console.flush();
      if (file.is_open())
        file.flush();
      return 0;
    }

  private:
    std::ostream &console;
    std::ofstream file;
    std::string   owed;
  };


  Log::Log(MPI_Comm communicator, std::ostream &console)
    : active(is_root(communicator))
    , tee(std::make_unique<Tee>(console))
    , output(active ? tee.get() : nullptr)
  {}


  Log::~Log() = default;


  void
  Log::open(const std::string &filename, const bool append)
  {
    if (active && !tee->open(filename, append))
      throw InputError("the log file " + filename + " cannot be written");
  }


  void
  Log::warning(const std::string &text)
  {
    if (std::find(warning_list.begin(), warning_list.end(), text) !=
        warning_list.end())
      return;
    warning_list.push_back(text);
    if (active)
      output << (tee->at_line_start ? "" : "\n") << "Warning: " << text << '\n';
  }


  const std::vector<std::string> &
  Log::warnings() const
  {
    return warning_list;
  }


  bool
  Log::is_active() const
  {
    return active;
  }


  std::ostream &
  Log::stream()
  {
    return output;
  }


  Log &
  Log::operator<<(std::ostream &(*manipulator)(std::ostream &))
  {
    if (active)
      output << manipulator;
    return *this;
  }
} // namespace Perimorph::Base
