#include <perimorph/base/exceptions.h>
#include <perimorph/mesh/nodal_mesh.h>
#include <perimorph/output/field_output.h>

#include <deal.II/base/mpi.h>

#include "test_meshes.h"
#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

using namespace Perimorph;

namespace
{
  /// A folder of this process alone, gone at the end of the test: the same
  /// tests may run at the same time on other numbers of ranks.
  struct TemporaryFolder
  {
    TemporaryFolder()
    {
      std::filesystem::create_directories(path);
    }
    ~TemporaryFolder()
    {
      std::filesystem::remove_all(path);
    }

    const std::string path = (std::filesystem::temp_directory_path() /
                              ("perimorph_output_" + std::to_string(getpid())))
                               .string();
  };


  std::string
  contents(const std::string &filename)
  {
    std::ifstream     file(filename);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }


  std::vector<unsigned char>
  decode_base64(const std::string &text)
  {
    const std::string          digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                        "abcdefghijklmnopqrstuvwxyz0123456789+/";
    std::vector<unsigned char> bytes;
    unsigned int               bits = 0, n_bits = 0;
    for (const char character : text)
      {
        if (character == '=')
          break;
        bits = (bits << 6) | static_cast<unsigned int>(digits.find(character));
        n_bits += 6;
        if (n_bits >= 8)
          {
            n_bits -= 8;
            bytes.push_back(static_cast<unsigned char>(bits >> n_bits));
          }
      }
    return bytes;
  }


  /// Reads an array back: an independent reading of VTK's format.
  template <typename T>
  std::vector<T>
  read_array(const std::string &vtu, const std::string &name)
  {
    const std::size_t key   = vtu.find("Name=\"" + name + "\"");
    const std::size_t begin = vtu.find('\n', key) + 1;
    const std::string text  = vtu.substr(begin, vtu.find('\n', begin) - begin);

    std::uint64_t n_blocks;
    std::memcpy(&n_blocks, decode_base64(text.substr(0, 12)).data(), 8);
    const std::size_t          header_length = (8 * (3 + n_blocks) + 2) / 3 * 4;
    std::vector<std::uint64_t> header(3 + n_blocks);
    std::memcpy(header.data(),
                decode_base64(text.substr(0, header_length)).data(),
                8 * header.size());
    const auto packed = decode_base64(text.substr(header_length));

    std::vector<unsigned char> bytes;
    std::size_t                offset = 0;
    for (std::size_t block = 0; block < n_blocks; ++block)
      {
        uLongf length =
          (block + 1 == n_blocks && header[2] > 0) ? header[2] : header[1];
        std::vector<unsigned char> plain(length);
        if (uncompress(plain.data(),
                       &length,
                       packed.data() + offset,
                       header[3 + block]) != Z_OK)
          throw std::runtime_error("block does not unpack");
        offset += header[3 + block];
        bytes.insert(bytes.end(), plain.begin(), plain.end());
      }
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }


  bool
  is_root()
  {
    return dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  }
} // namespace


TEST(FieldOutput, DisplacementIsOneVectorOfThreeComponents)
{
  if (!is_root())
    return;
  const TemporaryFolder             folder;
  const auto                        mesh = Testing::unit_mesh<2>(3);
  Output::FieldOutput<2>            output(folder.path, mesh);
  Output::Fields<2>                 fields;
  std::vector<dealii::Tensor<1, 2>> displacement(mesh.n_nodes());
  std::vector<double>               flat;
  for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
    {
      displacement[n][0] = 0.1 * n;
      displacement[n][1] = -1. / 3. * n;
      flat.push_back(displacement[n][0]);
      flat.push_back(displacement[n][1]);
    }
  fields.add("displacement", displacement);
  fields.add_vector("same", flat);
  output.write(7, 0.5, fields);

  const std::string vtu = contents(folder.path + "/solution_0007.vtu");
  EXPECT_NE(vtu.find("Name=\"displacement\" NumberOfComponents=\"3\""),
            std::string::npos);
  const auto values = read_array<double>(vtu, "displacement");
  ASSERT_EQ(values.size(), 3 * mesh.n_nodes());
  for (unsigned int n = 0; n < mesh.n_nodes(); ++n)
    {
      EXPECT_EQ(values[3 * n], displacement[n][0]);
      EXPECT_EQ(values[3 * n + 1], displacement[n][1]);
      EXPECT_EQ(values[3 * n + 2], 0.);
    }
  EXPECT_EQ(values, read_array<double>(vtu, "same"));
}


TEST(FieldOutput, CellsGoAroundTheirFacesAndShareTheirNodes)
{
  if (!is_root())
    return;
  const TemporaryFolder  folder;
  const auto             mesh = Testing::unit_mesh<3>(2);
  Output::FieldOutput<3> output(folder.path, mesh);
  output.write(1, 1., Output::Fields<3>());

  const std::string vtu    = contents(folder.path + "/solution_0001.vtu");
  const auto        points = read_array<double>(vtu, "Points");
  const auto        nodes  = read_array<std::int32_t>(vtu, "connectivity");
  ASSERT_EQ(points.size(), 3u * 27u);
  ASSERT_EQ(nodes.size(), 8u * 8u);
  EXPECT_EQ(read_array<std::uint8_t>(vtu, "types"),
            std::vector<std::uint8_t>(8, 12));
  EXPECT_EQ(read_array<std::int32_t>(vtu, "offsets").back(), 64);
  // neighbours in VTK's order are joined by an edge of length 1/2
  for (unsigned int cell = 0; cell < 8; ++cell)
    for (unsigned int v = 0; v < 4; ++v)
      for (const unsigned int other : {(v + 1) % 4, v + 4})
        {
          double length = 0.;
          for (unsigned int d = 0; d < 3; ++d)
            length += std::abs(points[3 * nodes[8 * cell + v] + d] -
                               points[3 * nodes[8 * cell + other] + d]);
          EXPECT_NEAR(length, 0.5, 1e-14);
        }
}


TEST(FieldOutput, ArraysOfSeveralBlocksReadBack)
{
  if (!is_root())
    return;
  const TemporaryFolder folder;
  Output::VtuGrid       grid;
  grid.points.assign(3 * 300000, 0.);
  for (std::int32_t n = 0; n < 300000; ++n)
    {
      grid.points[3 * n] = 1. / (n + 1);
      grid.connectivity.push_back(n);
    }
  Output::write_vtu(folder.path + "/test_blocks.vtu", grid, 0.);
  const std::string vtu = contents(folder.path + "/test_blocks.vtu");
  EXPECT_EQ(read_array<double>(vtu, "Points"), grid.points);
  EXPECT_EQ(read_array<std::int32_t>(vtu, "connectivity"), grid.connectivity);
}


TEST(FieldOutput, TensorsComeByComponents)
{
  dealii::SymmetricTensor<2, 2> stress;
  stress[0][0] = 1.;
  stress[1][1] = 2.;
  stress[0][1] = 3.;
  Output::Fields<2> plane;
  plane.add("stress", std::vector<dealii::SymmetricTensor<2, 2>>(1, stress));
  ASSERT_EQ(plane.arrays().size(), 3u);
  EXPECT_EQ(plane.arrays()[1].name, "stress_yy");
  EXPECT_EQ(plane.arrays()[2].name, "stress_xy");
  EXPECT_EQ(plane.arrays()[2].values, std::vector<double>(1, 3.));

  Output::Fields<3> solid;
  solid.add("stress", std::vector<dealii::SymmetricTensor<2, 3>>(2));
  ASSERT_EQ(solid.arrays().size(), 6u);
  EXPECT_EQ(solid.arrays()[5].name, "stress_yz");
}


TEST(FieldOutput, SeriesListsEveryStepOnceOnRankZero)
{
  const TemporaryFolder folder;
  auto                  mesh = Testing::unit_mesh<2>(2);
  mesh.rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  Output::FieldOutput<2> output(folder.path, mesh);
  Output::Fields<2>      fields;
  fields.add("alpha", std::vector<double>(2, 0.25));
  for (const unsigned int step : {1, 2, 2})
    {
      output.write(step, 0.1 * step, Output::Fields<2>());
      output.write_particles(step, 0.1 * step, {4, 8}, fields);
    }
  EXPECT_EQ(output.is_active(), is_root());
  if (!is_root())
    {
      EXPECT_TRUE(output.files().empty());
      return;
    }
  EXPECT_EQ(output.files(),
            std::vector<std::string>({"solution.pvd", "particles.pvd"}));
  const std::string pvd = contents(folder.path + "/particles.pvd");
  EXPECT_NE(pvd.find("timestep=\"0.1\" group=\"\" part=\"0\" "
                     "file=\"particles_0001.vtu\""),
            std::string::npos);
  EXPECT_EQ(pvd.find("particles_0002.vtu"), pvd.rfind("particles_0002.vtu"));
  const auto points =
    read_array<double>(contents(folder.path + "/particles_0002.vtu"), "Points");
  EXPECT_EQ(points.size(), 6u);
  EXPECT_EQ(points[3], mesh.nodes[8][0]);
}


TEST(FieldOutput, WrongSizeAndMissingFolderAreRefused)
{
  if (!is_root())
    return;
  const TemporaryFolder  folder;
  const auto             mesh = Testing::unit_mesh<2>(2);
  Output::FieldOutput<2> output("no_such_folder", mesh);
  EXPECT_THROW(output.write(1, 0., Output::Fields<2>()), Base::InputError);

  Output::FieldOutput<2> here(folder.path, mesh);
  Output::Fields<2>      fields;
  fields.add("alpha", std::vector<double>(3));
  EXPECT_THROW(here.write(1, 0., fields), std::logic_error);
  EXPECT_THROW(fields.add_vector("u", std::vector<double>(3)),
               std::logic_error);
}
