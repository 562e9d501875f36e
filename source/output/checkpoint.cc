#include <perimorph/base/exceptions.h>
#include <perimorph/output/checkpoint.h>

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace Perimorph::Output
{
  using Json = nlohmann::json;

  namespace
  {
    const std::string first_words = "Perimorph checkpoint";
    /// Of the envelope; what is inside goes by the version of the program.
    constexpr unsigned int format = 1;

    /// Doubles as the machine has them: exact, and fast for long arrays.
    std::vector<std::uint8_t>
    to_bytes(const std::vector<double> &values)
    {
      std::vector<std::uint8_t> bytes(sizeof(double) * values.size());
      if (!values.empty())
        std::memcpy(bytes.data(), values.data(), bytes.size());
      return bytes;
    }

    std::vector<double>
    to_doubles(const std::vector<std::uint8_t> &bytes)
    {
      std::vector<double> values(bytes.size() / sizeof(double));
      if (!values.empty())
        std::memcpy(values.data(), bytes.data(), bytes.size());
      return values;
    }

    unsigned long
    checksum(const std::uint8_t *data, const std::size_t size)
    {
      return crc32_z(0, data, size);
    }

    [[noreturn]] void
    refuse(const std::string &filename,
           const std::string &found,
           const std::string &hint)
    {
      throw Base::InputError(Base::InputMessage{"checkpoint '" + filename + "'",
                                                found,
                                                "the file 'checkpoint' of a "
                                                "run with 'Output / "
                                                "checkpoint = true'",
                                                hint});
    }
  } // namespace


  void
  write_checkpoint(const std::string &filename, const Checkpoint &checkpoint)
  {
    Json                json;
    Json                names = Json::array();
    std::vector<double> values;
    for (const auto &[name, value] : checkpoint.numbers)
      {
        names.push_back(name);
        values.push_back(value);
      }
    json["number names"] = names;
    json["numbers"]      = Json::binary(to_bytes(values));
    json["arrays"]       = Json::object();
    for (const auto &[name, array] : checkpoint.arrays)
      json["arrays"][name] = Json::binary(to_bytes(array));
    json["words"]      = checkpoint.words;
    const auto content = Json::to_cbor(json);

    const std::string aside = filename + ".part";
    std::ofstream     file(aside, std::ios::binary);
    file << first_words << ' ' << format << ' ' << content.size() << ' '
         << checksum(content.data(), content.size()) << '\n';
    file.write(reinterpret_cast<const char *>(content.data()),
               static_cast<std::streamsize>(content.size()));
    file.close();
    if (!file || std::rename(aside.c_str(), filename.c_str()) != 0)
      throw Base::InputError("the checkpoint " + filename +
                             " cannot be written");
  }


  Checkpoint
  read_checkpoint(const std::string &filename)
  {
    std::error_code status;
    if (!std::filesystem::is_regular_file(filename, status))
      refuse(filename,
             "no such file",
             "Run without --resume to start from the beginning.");
    std::ifstream file(filename, std::ios::binary);
    std::string   line;
    std::getline(file, line);
    if (line.compare(0, first_words.size(), first_words) != 0)
      refuse(filename, "something that is not a checkpoint", "");
    std::istringstream header(line.substr(first_words.size()));
    unsigned int       its_format = 0;
    std::size_t        size       = 0;
    unsigned long      sum        = 0;
    header >> its_format >> size >> sum;
    if (header && its_format != format)
      refuse(filename,
             "format " + std::to_string(its_format) +
               "; this program reads format " + std::to_string(format),
             "");
    const std::vector<std::uint8_t> content{
      std::istreambuf_iterator<char>(file),
      {}};
    if (!header || content.size() != size ||
        checksum(content.data(), content.size()) != sum)
      refuse(filename,
             "a damaged file (its length or checksum is wrong)",
             "Run without --resume to start from the beginning.");

    const Json json   = Json::from_cbor(content);
    const auto values = to_doubles(json.at("numbers").get_binary());
    Checkpoint checkpoint;
    for (std::size_t k = 0; k < values.size(); ++k)
      checkpoint.numbers[json.at("number names").at(k)] = values[k];
    for (const auto &[name, array] : json.at("arrays").items())
      checkpoint.arrays[name] = to_doubles(array.get_binary());
    checkpoint.words = json.at("words").get<decltype(checkpoint.words)>();
    return checkpoint;
  }
} // namespace Perimorph::Output
