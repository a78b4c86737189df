"""A renderer in a process of its own, which keeps its scene loaded: jobs and answers are lines of JSON.

The parent (Worker) sends the Job, then {samples, seed, image}; the child (serve) saves the image as .npy and answers {seconds}.
"""

import contextlib
import importlib
import json
import os
import subprocess
import sys
from dataclasses import dataclass

import numpy as np

from .scenes import Job


class RendererFailed(RuntimeError):
    """A renderer could not start or draw."""


@dataclass(frozen=True)
class Drawing:
    """An image (height, width, 3) of linear radiance and the seconds that tracing it took."""

    image: np.ndarray
    seconds: float


class Worker:
    """Runs the module renderers.NAME, which has `load(job)`: it returns a function (samples, seed) -> Drawing."""

    def __init__(self, name, log, environment):
        self.name, self.log, self.folder = name, log, None
        with open(log, "w") as errors:
            self.process = subprocess.Popen(
                [sys.executable, "-m", "renderers.worker", name],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=errors,
                text=True,
                env={**os.environ, **environment},
            )

    def load(self, job):
        """Sends the scene; to be called once, before draw."""
        self.folder = job.folder
        self.ask(job.to_json())

    def ask(self, line):
        try:
            self.process.stdin.write(line + "\n")
            self.process.stdin.flush()
            answer = self.process.stdout.readline()
        except BrokenPipeError:
            answer = ""
        if not answer:
            raise RendererFailed(f"{self.name} ended early: see {self.log}")
        return json.loads(answer)

    def draw(self, samples, seed):
        target = os.path.join(self.folder, f"{self.name}.npy")
        answer = self.ask(json.dumps({"samples": samples, "seed": seed, "image": target}))
        return Drawing(np.load(target), answer["seconds"])

    def close(self):
        with contextlib.suppress(BrokenPipeError):
            self.process.stdin.close()
        self.process.wait()


def serve(load):
    """The child's side: what libraries print goes to the log, answers alone to the parent."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)

    def answer(value):
        print(json.dumps(value), file=answers, flush=True)

    draw = load(Job.from_json(sys.stdin.readline()))
    answer({})
    for line in sys.stdin:
        request = json.loads(line)
        drawing = draw(request["samples"], request["seed"])
        np.save(request["image"], drawing.image.astype(np.float32))
        answer({"seconds": drawing.seconds})


if __name__ == "__main__":
    serve(importlib.import_module(f"renderers.{sys.argv[1]}").load)
