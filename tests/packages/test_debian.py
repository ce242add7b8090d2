"""The Debian packages."""
import os
import subprocess
import unittest

from support import PACKAGES, ROOT, VERSION, Case


def can_mount():
    """Whether a copy of the machine in memory can be had, which containers may forbid."""
    layers = ("mount -t tmpfs none /mnt && mkdir /mnt/upper /mnt/work /mnt/root && "
              "mount -t overlay overlay -o lowerdir=/,upperdir=/mnt/upper,workdir=/mnt/work /mnt/root && mount --bind /proc /mnt/root/proc")
    return os.geteuid() == 0 and subprocess.run(["unshare", "--mount", "sh", "-c", layers], capture_output=True).returncode == 0


class Debian(Case):
    def field(self, path, name):
        return self.call("dpkg-deb", "--field", path, name).strip()

    def test_fields(self):
        library = f"libvspring{'.'.join(VERSION.split('.')[:2]) if VERSION.startswith('0.') else VERSION.split('.')[0]}"
        for name, needed in {"vspring": ("libc6", "libfmt9", "libcpp-httplib0.11"), library: ("libc6", "libfmt9", "libstdc++6"),
                             "libvspring-dev": (f"{library} (= {VERSION}-1)", "libeigen3-dev"),
                             "python3-vspring": ("libfmt9", "python3 (<< 3.12)", "python3-numpy")}.items():
            path = self.package(f"{name}_{VERSION}-1_*.deb")
            self.assertEqual(self.field(path, "Version"), f"{VERSION}-1")
            for package in needed:
                self.assertIn(package, self.field(path, "Depends"), name)
            # Whatever a user unpacks has its licence, and belongs to root.
            contents = self.call("dpkg-deb", "--contents", path)
            self.assertIn(f"./usr/share/doc/{name}/copyright", contents)
            self.assertEqual([line for line in contents.splitlines() if " root/root " not in line], [])

    @unittest.skipUnless(can_mount(), "needs root, and a kernel that lets it mount")
    def test_install_use_and_purge(self):
        done = subprocess.run([ROOT / "tests/packages/debian_root", PACKAGES, VERSION], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_unpacked(self):
        """The program runs from wherever its package is unpacked, and its page comes along."""
        self.call("dpkg-deb", "--extract", self.package(f"vspring_{VERSION}-1_*.deb"), self.folder)
        program = self.folder / "usr/bin/vspring"
        self.assertEqual(self.call(program, "--version"), f"vspring {VERSION}\n")
        self.call(program, "fair", self.hat(), "-o", "fair.obj", "--quiet")
        self.assertTrue((self.folder / "usr/share/vspring/editor/index.html").exists())


if __name__ == "__main__":
    unittest.main()
