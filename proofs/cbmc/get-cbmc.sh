#!/usr/bin/env bash
# Puts CBMC of Debian's next release into a folder, with its own loader and libraries: nothing of the system changes.
set -euo pipefail
folder=${1:?usage: get-cbmc.sh FOLDER}
mkdir -p "$folder"/{lists/partial,archives/partial,sources,debs,root}
folder=$(cd "$folder" && pwd)
mirror=$(grep -hm1 '^URIs:' /etc/apt/sources.list.d/debian.sources | cut -d' ' -f2)
cat > "$folder/sources/next.sources" <<EOF
Types: deb
URIs: $mirror
Suites: trixie
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
EOF
: > "$folder/status"
cat > "$folder/apt.conf" <<EOF
Dir::Etc::sourcelist "/dev/null";
Dir::Etc::sourceparts "$folder/sources";
Dir::State "$folder";
Dir::State::status "$folder/status";
Dir::Cache "$folder";
APT::Architecture "amd64";
APT::Sandbox::User "root";
EOF
export APT_CONFIG="$folder/apt.conf"
apt-get -qq update
(cd "$folder/debs" && apt-get -qq download cbmc minisat libc6 libstdc++6 libgcc-s1)
for package in "$folder"/debs/*.deb; do
    dpkg-deb -x "$package" "$folder/root"
done
for tool in cbmc goto-cc; do
    cat > "$folder/$tool" <<EOF
#!/bin/sh
root=$folder/root
libraries=\$root/usr/lib/x86_64-linux-gnu
exec "\$libraries/ld-linux-x86-64.so.2" --library-path "\$libraries:\$root/usr/lib" "\$root/usr/bin/$tool" "\$@"
EOF
    chmod +x "$folder/$tool"
done
