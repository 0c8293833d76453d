#include "common/files/regular_file.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>

#include <cstring>

#include "import/fake_reader.h"
#include "oracle/failure.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::regular_file_test {

using test::failureOf;
using RegularFile = test::FakeReader;

TEST_F(RegularFile, IsReadWhole) {
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, (std::size_t{1} << 24) - 1, std::size_t{1} << 24, (std::size_t{3} << 24) + 5}) {
    std::string bytes(size, 'x');
    for (std::size_t i = 0; i < size; i += 4099) bytes[i] = static_cast<char>(i);
    EXPECT_TRUE(readRegularFile(write("file", bytes)) == bytes) << size;
  }
  EXPECT_FALSE(readRegularFile("/proc/self/status").empty());  // says that it holds 0 bytes
}

TEST_F(RegularFile, NothingElseIsOpened) {
  const std::string fifo = (directory_ / "fifo.stl").string(), socket_path = (directory_ / "socket.stl").string();
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const int server = ::socket(AF_UNIX, SOCK_STREAM, 0);
  struct sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, socket_path.c_str(), sizeof address.sun_path - 1);
  ASSERT_EQ(::bind(server, reinterpret_cast<struct sockaddr*>(&address), sizeof address), 0);
  ::symlink("/dev/zero", (directory_ / "link.stl").c_str());
  for (const std::string& path :
       {fifo, socket_path, std::string("/dev/zero"), std::string("/dev/null"), (directory_ / "link.stl").string()}) {
    EXPECT_EQ(failureOf([&] { readRegularFile(path); }), "is not a regular file") << path;
    double resolution = 0.0;
    EXPECT_EQ(failureOf([&] { loadMesh(path); }), path + ": is not a regular file");
    EXPECT_EQ(failureOf([&] { loadOctomapSurface(path, resolution); }), path + ": is not a regular file");
  }
  ::close(server);
  EXPECT_EQ(failureOf([&] { readRegularFile(directory_.string()); }), "is a directory");
  EXPECT_EQ(failureOf([&] { readRegularFile("/no/such/file"); }), "cannot be opened: No such file or directory");
  EXPECT_EQ(failureOf([&] { readRegularFile(std::string(100000, 'x')); }), "cannot be opened: File name too long");
}

TEST_F(RegularFile, SizeIsBounded) {
  const std::string path = write("file", std::string(3 << 20, 'x'));
  EXPECT_EQ(readRegularFile(path, 3 << 20).size(), 3u << 20);
  EXPECT_EQ(failureOf([&] { readRegularFile(path, 2 << 20); }), "larger than 2 MiB");
  const std::string sparse = write("sparse.stl", "");
  ASSERT_EQ(::truncate(sparse.c_str(), off_t{1} << 40), 0);
  EXPECT_EQ(failureOf([&] { loadMesh(sparse); }), sparse + ": larger than 1024 MiB");
}

}  // namespace sdf_ccd::regular_file_test
