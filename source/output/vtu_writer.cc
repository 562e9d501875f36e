#include <perimorph/base/exceptions.h>
#include <perimorph/output/csv_writer.h>
#include <perimorph/output/vtu_writer.h>

#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace Perimorph::Output
{
  namespace
  {
    using Bytes = std::vector<unsigned char>;

    std::string
    base64(const Bytes &bytes)
    {
      static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                   "abcdefghijklmnopqrstuvwxyz0123456789+/";
      std::string       text;
      text.reserve((bytes.size() + 2) / 3 * 4);
      for (std::size_t i = 0; i < bytes.size(); i += 3)
        {
          const std::size_t n     = std::min<std::size_t>(3, bytes.size() - i);
          std::uint32_t     group = 0;
          for (std::size_t k = 0; k < 3; ++k)
            group = (group << 8) | (k < n ? bytes[i + k] : 0u);
          for (std::size_t k = 0; k < 4; ++k)
            text += k <= n ? digits[(group >> (18 - 6 * k)) & 63u] : '=';
        }
      return text;
    }


    void
    append(Bytes &bytes, const std::uint64_t number)
    {
      unsigned char raw[sizeof(number)];
      std::memcpy(raw, &number, sizeof(number));
      bytes.insert(bytes.end(), raw, raw + sizeof(number));
    }


    /// VTK's compressed array: the header (number of blocks, their size, size
    /// of the last one if it is shorter, compressed size of each), then the
    /// blocks, both as base64.
    template <typename T>
    std::string
    compressed(const std::vector<T> &values)
    {
      constexpr std::size_t block_size = 1u << 20;
      const auto       *data = reinterpret_cast<const Bytef *>(values.data());
      const std::size_t size = values.size() * sizeof(T);

      Bytes header, blocks;
      append(header, (size + block_size - 1) / block_size);
      append(header, block_size);
      append(header, size % block_size);
      for (std::size_t begin = 0; begin < size; begin += block_size)
        {
          const uLong length = std::min(block_size, size - begin);
          uLongf      packed = compressBound(length);
          Bytes       block(packed);
          if (compress2(block.data(),
                        &packed,
                        data + begin,
                        length,
                        Z_BEST_SPEED) != Z_OK)
            throw std::runtime_error("zlib could not compress an array");
          blocks.insert(blocks.end(), block.begin(), block.begin() + packed);
          append(header, packed);
        }
      return base64(header) + base64(blocks);
    }


    template <typename T>
    void
    write_array(std::ostream         &out,
                const char           *type,
                const std::string    &name,
                const unsigned int    n_components,
                const std::vector<T> &values)
    {
      out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\"";
      if (n_components > 1)
        out << " NumberOfComponents=\"" << n_components << "\"";
      out << " format=\"binary\">\n"
          << compressed(values) << "\n</DataArray>\n";
    }


    void
    write_data(std::ostream                &out,
               const char                  *section,
               const std::vector<VtuArray> &arrays,
               const std::size_t            n_tuples)
    {
      out << "<" << section << ">\n";
      for (const VtuArray &array : arrays)
        {
          if (array.values.size() != n_tuples * array.n_components)
            throw std::logic_error("field '" + array.name + "' has " +
                                   std::to_string(array.values.size()) +
                                   " values instead of " +
                                   std::to_string(n_tuples) + " times " +
                                   std::to_string(array.n_components));
          write_array(out,
                      "Float64",
                      array.name,
                      array.n_components,
                      array.values);
        }
      out << "</" << section << ">\n";
    }
  } // namespace


  unsigned int
  VtuGrid::n_points_per_cell() const
  {
    switch (cell_type)
      {
        case VtuCell::line:
          return 2;
        case VtuCell::triangle:
          return 3;
        case VtuCell::quadrilateral:
          return 4;
        case VtuCell::hexahedron:
          return 8;
        default:
          return 1;
      }
  }


  void
  write_vtu(const std::string &filename, const VtuGrid &grid, const double time)
  {
    const std::size_t n_points = grid.points.size() / 3;
    const std::size_t n_cells =
      grid.connectivity.size() / grid.n_points_per_cell();

    std::vector<std::int32_t> cell_ends(n_cells);
    for (std::size_t cell = 0; cell < n_cells; ++cell)
      cell_ends[cell] =
        static_cast<std::int32_t>((cell + 1) * grid.n_points_per_cell());
    const std::vector<std::uint8_t> types(
      n_cells,
      static_cast<std::uint8_t>(grid.cell_type));

    std::ofstream out(filename, std::ios::binary);
    out << "<?xml version=\"1.0\"?>\n"
        << "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        << "byte_order=\"LittleEndian\" header_type=\"UInt64\" "
        << "compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n"
        << "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" "
        << "NumberOfTuples=\"1\" format=\"ascii\">" << shortest_text(time)
        << "</DataArray>\n</FieldData>\n"
        << "<Piece NumberOfPoints=\"" << n_points << "\" NumberOfCells=\""
        << n_cells << "\">\n";
    out << "<Points>\n";
    write_array(out, "Float64", "Points", 3, grid.points);
    out << "</Points>\n<Cells>\n";
    write_array(out, "Int32", "connectivity", 1, grid.connectivity);
    write_array(out, "Int32", "offsets", 1, cell_ends);
    write_array(out, "UInt8", "types", 1, types);
    out << "</Cells>\n";
    write_data(out, "PointData", grid.point_data, n_points);
    write_data(out, "CellData", grid.cell_data, n_cells);
    out << "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    out.close();
    if (!out)
      throw Base::InputError("the file " + filename + " cannot be written");
  }


  void
  write_pvd(const std::string                                 &filename,
            const std::vector<std::pair<double, std::string>> &steps)
  {
    const std::string aside = filename + ".part";
    std::ofstream     out(aside);
    out << "<?xml version=\"1.0\"?>\n"
        << "<VTKFile type=\"Collection\" version=\"0.1\" "
        << "byte_order=\"LittleEndian\">\n<Collection>\n";
    for (const auto &[time, file] : steps)
      out << "<DataSet timestep=\"" << shortest_text(time)
          << "\" group=\"\" part=\"0\" file=\"" << file << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
    out.close();
    if (!out || std::rename(aside.c_str(), filename.c_str()) != 0)
      throw Base::InputError("the file " + filename + " cannot be written");
  }
} // namespace Perimorph::Output
