#!/usr/bin/env python3
"""Reads a recording with the MCAP project's own Python reader and with rosbags, decodes every ROS 2
message and prints what it found.

  independent_reader.py --venv DIR FILE [--expect TOPIC=COUNT ...]
  independent_reader.py --venv DIR                 only makes the environment

The readers come from PyPI into the virtual environment DIR, made when missing. Exit codes: 0 the
file is whole and holds what was expected, 1 it does not, 77 skipped (PyPI not reachable).
"""
import argparse
import os
import subprocess
import sys
from pathlib import Path

PACKAGES = ["mcap==1.6.0", "mcap-ros2-support==0.6.0", "rosbags==0.11.9"]
SKIPPED = 77


def skip() -> None:
    print("skipped: PyPI not reachable")
    sys.exit(SKIPPED)


def enter_environment(folder: Path, try_again: bool) -> None:
    """Starts this script again with the environment's Python, where it is not that already."""
    if Path(sys.prefix).resolve() == folder.resolve():
        return
    python = folder / "bin" / "python"
    complete = folder / "complete"
    unreachable = folder.with_suffix(".unreachable")
    if try_again:
        unreachable.unlink(missing_ok=True)
    if not complete.exists():
        if unreachable.exists():
            skip()
        made = subprocess.run([sys.executable, "-m", "venv", "--clear", str(folder)])
        installed = made.returncode == 0 and subprocess.run(
            [str(python), "-m", "pip", "install", "--quiet", "--disable-pip-version-check",
             "--retries", "1", "--timeout", "10", *PACKAGES]).returncode == 0
        if not installed:
            unreachable.touch()
            skip()
        complete.touch()
    os.execv(python, [str(python), *sys.argv])


def read_with_index(path: Path) -> dict:
    """Counts by topic, through the summary and the chunk index, every CRC checked."""
    from mcap.reader import make_reader
    from mcap_ros2.decoder import DecoderFactory

    counts: dict = {}
    last: dict = {}
    with path.open("rb") as stream:
        reader = make_reader(stream, validate_crcs=True, decoder_factories=[DecoderFactory()])
        summary = reader.get_summary()
        assert summary is not None, "no summary"
        previous = 0
        for schema, channel, message, decoded in reader.iter_decoded_messages():
            assert message.log_time >= previous, "messages are not in log time order"
            previous = message.log_time
            assert channel.message_encoding == "cdr" and schema.encoding == "ros2msg"
            counts[channel.topic] = counts.get(channel.topic, 0) + 1
            last[channel.topic] = (schema.name, decoded)
        statistics = summary.statistics
        assert statistics.message_count == sum(counts.values()), "statistics do not agree"
        assert statistics.chunk_count == len(summary.chunk_indexes)
        names = [record.name for record in reader.iter_metadata()]
        profile = reader.get_header().profile
    print(f"header profile {profile!r}, {statistics.chunk_count} chunks, "
          f"{statistics.message_count} messages, metadata {names}")
    for topic, count in sorted(counts.items()):
        name, decoded = last[topic]
        print(f"  {topic}: {count} x {name}, last {str(decoded)[:160]}")
    return counts


def read_as_stream(path: Path) -> int:
    """Number of messages, record after record from the start, the data section's CRC checked."""
    from mcap.records import Message
    from mcap.stream_reader import StreamReader

    with path.open("rb") as stream:
        records = StreamReader(stream, validate_crcs=True).records
        return sum(isinstance(record, Message) for record in records)


def read_with_rosbags(path: Path) -> dict:
    """Counts by topic, every message decoded by the schema in the file."""
    from rosbags.highlevel import AnyReader

    counts: dict = {}
    with AnyReader([path]) as reader:
        for connection, _, data in reader.messages():
            reader.deserialize(data, connection.msgtype)
            counts[connection.topic] = counts.get(connection.topic, 0) + 1
    return counts


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path, nargs="?")
    parser.add_argument("--venv", type=Path, required=True)
    parser.add_argument("--make", help="program that writes the file: PROGRAM FILE COUNT first")
    parser.add_argument("--expect", action="append", default=[], metavar="TOPIC=COUNT")
    arguments = parser.parse_args()
    enter_environment(arguments.venv, try_again=arguments.file is None)
    if arguments.file is None:
        return 0

    expected = {topic: int(count)
                for topic, count in (entry.rsplit("=", 1) for entry in arguments.expect)}
    if arguments.make:
        arguments.file.unlink(missing_ok=True)
        subprocess.run([arguments.make, str(arguments.file), str(sum(expected.values()))],
                       check=True)
    counts = read_with_index(arguments.file)
    assert read_as_stream(arguments.file) == sum(counts.values()), "the two ways of reading differ"
    assert read_with_rosbags(arguments.file) == counts, "rosbags reads something else"
    for topic, count in expected.items():
        assert counts.get(topic) == count, f"{topic}: {counts.get(topic)} messages, not {count}"
    return 0


if __name__ == "__main__":
    sys.exit(main())
