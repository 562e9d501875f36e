#include <perimorph/base/name_help.h>
#include <perimorph/parameters/entry_table.h>
#include <perimorph/parameters/reader.h>
#include <perimorph/parameters/text_tools.h>

#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

namespace Perimorph::Parameters
{
  namespace
  {
    /// Splits "word rest" at the first blank.
    std::pair<std::string, std::string>
    split_first_word(const std::string &line)
    {
      const std::size_t blank = line.find_first_of(" \t");
      if (blank == std::string::npos)
        return {line, ""};
      return {line.substr(0, blank), trim(line.substr(blank))};
    }


    /// Reads the lines of one file: keeps the open sections and recovers
    /// after each error, so that one slip gives one message.
    class FileReader
    {
    public:
      FileReader(const std::string         &file_name,
                 dealii::ParameterHandler  &prm,
                 Base::InputErrorCollector &errors)
        : file_name(file_name)
        , table(prm)
        , errors(errors)
      {}

      void
      read(const std::string &text)
      {
        std::string       statement;
        bool              continued   = false;
        unsigned int      line_number = 0;
        std::size_t       begin       = 0;
        const std::string bom         = "\xEF\xBB\xBF";
        if (text.compare(0, bom.size(), bom) == 0)
          begin = bom.size();
        while (begin < text.size())
          {
            std::size_t end = text.find('\n', begin);
            if (end == std::string::npos)
              end = text.size();
            std::string line = text.substr(begin, end - begin);
            begin            = end + 1;
            ++line_number;
            if (!continued)
              {
                statement.clear();
                statement_line = line_number;
              }
            line      = trim(line.substr(0, line.find('#')));
            continued = !line.empty() && line.back() == '\\';
            if (continued)
              line.pop_back();
            statement += line;
            if (!continued)
              read_statement(trim(statement));
          }
        if (continued)
          read_statement(trim(statement));
        statement_line = line_number;
        for (const OpenSection &section : open_sections)
          add_missing_end(section, "before the end of the file");
      }

    private:
      struct OpenSection
      {
        std::string  name;
        unsigned int line;
        bool         known;
      };

      std::string
      place() const
      {
        return file_name + ":" + std::to_string(statement_line);
      }

      std::vector<std::string>
      current_sections() const
      {
        std::vector<std::string> names;
        for (const OpenSection &section : open_sections)
          names.push_back(section.name);
        return names;
      }

      bool
      inside_unknown_section() const
      {
        return !open_sections.empty() && !open_sections.back().known;
      }

      void
      read_statement(const std::string &statement)
      {
        if (statement.empty())
          return;
        const auto [word, rest] = split_first_word(statement);
        if (word == "set" || word == "SET")
          set(rest);
        else if (word == "subsection" || word == "SUBSECTION")
          open(condense_blanks(rest));
        else if ((word == "end" || word == "END") && rest.empty())
          close();
        else
          {
            const bool is_assignment =
              word != "end" && statement.find('=') != std::string::npos;
            errors.add(Base::InputMessage{
              "line " + place(),
              "'" + statement + "'",
              "set NAME = VALUE, subsection NAME, end, or a comment behind #",
              is_assignment ? "Is 'set' missing?" : ""});
          }
      }

      void
      add_missing_end(const OpenSection &section, const std::string &where)
      {
        errors.add("section '" + section.name + "' opened in " + file_name +
                   ":" + std::to_string(section.line) + " has no 'end' " +
                   where);
      }

      void
      open(const std::string &name)
      {
        if (name.empty())
          {
            errors.add(Base::InputMessage{
              "line " + place(),
              "'subsection' without a name",
              Base::join_names(table.section_names(current_sections())),
              ""});
            open_sections.push_back({name, statement_line, false});
            return;
          }
        std::vector<std::string> sections = current_sections();
        sections.push_back(name);
        const bool known = table.has_section(sections);
        if (!known && !open_sections.empty() && table.has_section({name}))
          {
            // the only sensible reading: sections before it were not closed
            for (const OpenSection &section : open_sections)
              add_missing_end(section,
                              "before 'subsection " + name + "' in line " +
                                std::to_string(statement_line));
            open_sections.clear();
            open_sections.push_back({name, statement_line, true});
            return;
          }
        if (!known && !inside_unknown_section())
          errors.add(
            "section '" + name + "' in " + place() + " is not known" +
            Base::did_you_mean(name, table.section_names(current_sections())));
        open_sections.push_back({name, statement_line, known});
      }

      void
      close()
      {
        if (open_sections.empty())
          errors.add("line " + place() +
                     "\n  found 'end', but no subsection is open; allowed: "
                     "one 'end' for each 'subsection'");
        else
          open_sections.pop_back();
      }

      void
      set(const std::string &assignment)
      {
        const std::size_t equals = assignment.find('=');
        const std::string name = condense_blanks(assignment.substr(0, equals));
        if (equals == std::string::npos || name.empty())
          {
            errors.add(Base::InputMessage{
              "line " + place(),
              "'set " + assignment + "' without " +
                (equals == std::string::npos ? "'='" : "a name before '='"),
              "set NAME = VALUE",
              ""});
            return;
          }
        if (inside_unknown_section())
          return;
        const DeclaredEntry *entry = table.find(current_sections(), name);
        if (entry == nullptr)
          {
            errors.add("entry '" + name + "' in " + place() +
                       " is not known in " + section_title(current_sections()) +
                       table.advice(current_sections(), name));
            return;
          }
        const auto [first, is_new] =
          lines_of_entries.emplace(entry->path(), statement_line);
        if (!is_new)
          {
            errors.add("parameter '" + entry->path() + "' in " + place() +
                       "\n  found a second time, first in line " +
                       std::to_string(first->second) +
                       "; allowed: once in a file");
            return;
          }
        errors.remember_origin(entry->path(), place());
        const std::string value = trim(assignment.substr(equals + 1));
        if (!has_second_set(*entry, value))
          table.set(*entry, value, errors);
      }

      /// Two assignments in one line: "linear elastic  set state = ...".
      bool
      has_second_set(const DeclaredEntry &entry, const std::string &value)
      {
        std::size_t position = value.find(" set ");
        for (; position != std::string::npos;
             position = value.find(" set ", position + 1))
          {
            const std::size_t begin = position + 5;
            const std::size_t end   = value.find('=', begin);
            if (end == std::string::npos)
              return false;
            const std::string name =
              condense_blanks(value.substr(begin, end - begin));
            if (table.find(entry.sections, name) == nullptr)
              continue;
            errors.add_parameter(entry.path(),
                                 "'set " + name + "' in the same line",
                                 "one 'set' per line");
            return true;
          }
        return false;
      }

      const std::string                   file_name;
      EntryTable                          table;
      Base::InputErrorCollector          &errors;
      std::vector<OpenSection>            open_sections;
      std::map<std::string, unsigned int> lines_of_entries;
      unsigned int                        statement_line = 0;
    };


    /// True if a line has a '=' or begins with 'set': without, it is no
    /// parameter file, and a message per line would not help.
    bool
    has_assignment(const std::string &text)
    {
      std::istringstream stream(text);
      for (std::string line; std::getline(stream, line);)
        {
          line                   = trim(line.substr(0, line.find('#')));
          const std::string word = split_first_word(line).first;
          if (word == "set" || word == "SET" ||
              line.find('=') != std::string::npos)
            return true;
        }
      return false;
    }


    /// Names of the parameter files beside a file which does not exist.
    std::vector<std::string>
    neighbours(const std::filesystem::path &file)
    {
      std::vector<std::string>    names;
      std::error_code             code;
      const std::filesystem::path folder =
        file.has_parent_path() ? file.parent_path() : ".";
      for (const auto &neighbour :
           std::filesystem::directory_iterator(folder, code))
        if (neighbour.path().extension() == ".prm")
          names.push_back(neighbour.path().filename().string());
      return names;
    }
  } // namespace


  bool
  read_text(const std::string         &text,
            const std::string         &file_name,
            dealii::ParameterHandler  &prm,
            Base::InputErrorCollector &errors)
  {
    if (text.find('\0') != std::string::npos)
      {
        errors.add(Base::InputMessage{"parameter file " + file_name,
                                      "binary data",
                                      "a text file",
                                      "Is it another file than you meant?"});
        return false;
      }
    if (!has_assignment(text))
      {
        errors.add("parameter file " + file_name +
                   "\n  found no 'set' in it; allowed: lines "
                   "'set NAME = VALUE' in 'subsection NAME' ... 'end'");
        return false;
      }
    FileReader(file_name, prm, errors).read(text);
    return true;
  }


  bool
  read_file(const std::string         &file_name,
            dealii::ParameterHandler  &prm,
            Base::InputErrorCollector &errors)
  {
    std::error_code code;
    if (std::filesystem::is_directory(file_name, code))
      {
        errors.add("parameter file " + file_name +
                   "\n  found a folder; allowed: a text file");
        return false;
      }
    if (!std::filesystem::exists(file_name, code))
      {
        const auto nearest = Base::nearest_name(
          std::filesystem::path(file_name).filename().string(),
          neighbours(file_name));
        errors.add("parameter file " + file_name + " does not exist" +
                   (nearest ? "; did you mean '" + *nearest + "'?" : ""));
        return false;
      }
    std::ifstream file(file_name, std::ios::binary);
    if (!file)
      {
        errors.add("parameter file " + file_name +
                   " cannot be opened for reading");
        return false;
      }
    const std::string text((std::istreambuf_iterator<char>(file)),
                           std::istreambuf_iterator<char>());
    return read_text(text, file_name, prm, errors);
  }

} // namespace Perimorph::Parameters
