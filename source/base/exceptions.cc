#include <perimorph/base/exceptions.h>

namespace Perimorph::Base
{
  namespace
  {
    std::string
    join_messages(const std::vector<std::string> &messages)
    {
      std::string text;
      for (const std::string &message : messages)
        text += (text.empty() ? "Error: " : "\nError: ") + message;
      return text;
    }
  } // namespace


  std::string
  InputMessage::text() const
  {
    std::string facts;
    if (!found.empty())
      facts = "found " + found;
    if (!allowed.empty())
      facts += (facts.empty() ? "allowed: " : "; allowed: ") + allowed;
    if (!hint.empty())
      facts += (facts.empty() ? "" : ". ") + hint;
    if (where.empty() || facts.empty())
      return where + facts;
    return where + "\n  " + facts;
  }


  InputError::InputError(const std::string &message)
    : InputError(std::vector<std::string>{message})
  {}


  InputError::InputError(const InputMessage &message)
    : InputError(message.text())
  {}


  InputError::InputError(const std::vector<std::string> &messages)
    : std::runtime_error(join_messages(messages))
    , message_list(messages)
  {}


  const std::vector<std::string> &
  InputError::messages() const
  {
    return message_list;
  }


  void
  InputErrorCollector::add(const std::string &message)
  {
    message_list.push_back(message);
  }


  void
  InputErrorCollector::add(const InputMessage &message)
  {
    add(message.text());
  }


  void
  InputErrorCollector::add_parameter(const std::string &path,
                                     const std::string &found,
                                     const std::string &allowed,
                                     const std::string &hint)
  {
    const auto        origin = origins.find(path);
    const std::string place =
      origin == origins.end() ? "" : " in " + origin->second;
    add(InputMessage{"parameter '" + path + "'" + place, found, allowed, hint});
  }


  void
  InputErrorCollector::remember_origin(const std::string &path,
                                       const std::string &origin)
  {
    origins[path] = origin;
  }


  void
  InputErrorCollector::collect(const std::function<void()> &check,
                               const std::string           &where)
  {
    try
      {
        check();
      }
    catch (const InputError &error)
      {
        for (const std::string &message : error.messages())
          add(where.empty() ? message : where + ": " + message);
      }
  }


  bool
  InputErrorCollector::empty() const
  {
    return message_list.empty();
  }


  std::size_t
  InputErrorCollector::size() const
  {
    return message_list.size();
  }


  const std::vector<std::string> &
  InputErrorCollector::messages() const
  {
    return message_list;
  }


  void
  InputErrorCollector::throw_if_any() const
  {
    if (!empty())
      throw InputError(message_list);
  }
} // namespace Perimorph::Base
