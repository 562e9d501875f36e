#include <perimorph/base/name_help.h>
#include <perimorph/parameters/entry_table.h>
#include <perimorph/parameters/patterns.h>
#include <perimorph/parameters/text_tools.h>

#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <cstddef>
#include <sstream>

namespace Perimorph::Parameters
{
  namespace
  {
    std::string
    join_path(const std::vector<std::string> &sections)
    {
      std::string path;
      for (const std::string &section : sections)
        path += (path.empty() ? "" : " / ") + section;
      return path;
    }


    void
    collect_entries(const boost::property_tree::ptree &tree,
                    const std::vector<std::string>    &sections,
                    std::vector<DeclaredEntry>        &entries)
    {
      for (const auto &[name, node] : tree)
        {
          // only an entry has a leaf of this name
          const auto default_value = node.find("default_value");
          if (default_value != node.not_found() &&
              default_value->second.empty())
            entries.push_back({sections,
                               name,
                               node.get<std::string>("value"),
                               default_value->second.data(),
                               node.get<std::string>("documentation"),
                               node.get<std::string>("pattern_description")});
          else
            {
              std::vector<std::string> inner_sections = sections;
              inner_sections.push_back(name);
              collect_entries(node, inner_sections, entries);
            }
        }
    }


    bool
    starts_with(const std::vector<std::string> &sections,
                const std::vector<std::string> &beginning)
    {
      return sections.size() >= beginning.size() &&
             std::equal(beginning.begin(), beginning.end(), sections.begin());
    }


    /// Sets inside of the sections of the entry, and leaves them whatever
    /// happens.
    void
    set_value(dealii::ParameterHandler &prm,
              const DeclaredEntry      &entry,
              const std::string        &value)
    {
      struct Inside
      {
        Inside(dealii::ParameterHandler       &prm,
               const std::vector<std::string> &sections)
          : prm(prm)
          , depth(sections.size())
        {
          for (const std::string &section : sections)
            prm.enter_subsection(section);
        }

        ~Inside()
        {
          for (std::size_t level = 0; level < depth; ++level)
            prm.leave_subsection();
        }

        dealii::ParameterHandler &prm;
        const std::size_t         depth;
      };
      const Inside inside(prm, entry.sections);
      prm.set(entry.name, value);
    }
  } // namespace


  std::string
  DeclaredEntry::path() const
  {
    return sections.empty() ? name : join_path(sections) + " / " + name;
  }


  std::vector<DeclaredEntry>
  list_entries(const dealii::ParameterHandler &prm)
  {
    // the handler keeps its table private; its JSON output has all of it
    std::stringstream json;
    prm.print_parameters(json,
                         dealii::ParameterHandler::JSON |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    boost::property_tree::ptree tree;
    boost::property_tree::read_json(json, tree);
    std::vector<DeclaredEntry> entries;
    collect_entries(tree, {}, entries);
    return entries;
  }


  EntryTable::EntryTable(dealii::ParameterHandler &prm)
    : prm(prm)
    , entries(list_entries(prm))
  {}


  bool
  EntryTable::has_section(const std::vector<std::string> &sections) const
  {
    return std::any_of(entries.begin(),
                       entries.end(),
                       [&sections](const DeclaredEntry &entry) {
                         return starts_with(entry.sections, sections);
                       });
  }


  std::vector<std::string>
  EntryTable::section_names(const std::vector<std::string> &sections) const
  {
    std::vector<std::string> names;
    for (const DeclaredEntry &entry : entries)
      if (entry.sections.size() > sections.size() &&
          starts_with(entry.sections, sections))
        {
          const std::string &name = entry.sections[sections.size()];
          if (std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
        }
    return names;
  }


  const DeclaredEntry *
  EntryTable::find(const std::vector<std::string> &sections,
                   const std::string              &name) const
  {
    for (const DeclaredEntry &entry : entries)
      if (entry.name == name && entry.sections == sections)
        return &entry;
    return nullptr;
  }


  std::string
  EntryTable::advice(const std::vector<std::string> &sections,
                     const std::string              &name) const
  {
    std::vector<std::string> here;
    std::vector<std::string> everywhere;
    for (const DeclaredEntry &entry : entries)
      {
        if (entry.name == name)
          return "; entry '" + name + "' belongs in " +
                 section_title(entry.sections);
        if (entry.sections == sections)
          here.push_back(entry.name);
        everywhere.push_back(entry.name);
      }
    if (!Base::nearest_name(name, here))
      if (const auto nearest = Base::nearest_name(name, everywhere))
        for (const DeclaredEntry &entry : entries)
          if (entry.name == *nearest)
            return "; did you mean '" + *nearest + "' in " +
                   section_title(entry.sections) + "?";
    return Base::did_you_mean(name, here);
  }


  void
  EntryTable::set(const DeclaredEntry       &entry,
                  const std::string         &value,
                  Base::InputErrorCollector &errors)
  {
    const std::string found = value.empty() ? "nothing" : "'" + value + "'";
    try
      {
        set_value(prm, entry, value);
      }
    catch (const dealii::ParameterHandler::ExcValueDoesNotMatchPattern &)
      {
        const auto nearest =
          Base::nearest_name(value, selection_names(entry.pattern));
        errors.add_parameter(entry.path(),
                             found,
                             plain_words(entry.pattern),
                             nearest ? "Did you mean '" + *nearest + "'?" : "");
      }
    catch (const dealii::ExceptionBase &exception)
      {
        // an action of the entry did not like the value
        std::ostringstream reason;
        exception.print_info(reason);
        errors.add_parameter(entry.path(),
                             found,
                             plain_words(entry.pattern),
                             condense_blanks(reason.str()));
      }
  }


  std::string
  section_title(const std::vector<std::string> &sections)
  {
    return sections.empty() ? "the top level"
                            : "section '" + join_path(sections) + "'";
  }
} // namespace Perimorph::Parameters
