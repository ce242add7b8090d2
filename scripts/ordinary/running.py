"""Runs tasks."""
import concurrent.futures
import itertools
import math
import pathlib
import resource
import shlex
import shutil
import signal
import subprocess
import tempfile

from ordinary.checks import Result, check_run, find_error, verdict_of, way_of, work_of
from ordinary.kinds import OF_THEIR_OWN
from ordinary.tasks import draw_task, kind_of


def limit_processor(seconds):
    """Of processor time: on a busy machine the same tasks are killed."""
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(seconds), math.ceil(seconds) + 5))


def processor_time():
    """Of programs that have ended, in seconds."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_task(number, context):
    """Draws, runs and checks one; a record of it."""
    task = OF_THEIR_OWN.get(context.kind, draw_task)(context.seed, number)
    with tempfile.TemporaryDirectory(prefix="ordinary-task-") as folder:
        folder = pathlib.Path(folder)
        for name, text in task.files.items():
            (folder / name).write_text(text)
        result = Result(task, folder)
        begin = processor_time()
        try:
            process = subprocess.run([context.sessions if task.drag else context.program, *task.arguments], cwd=folder, capture_output=True, timeout=10 * context.limit,
                                     preexec_fn=lambda: limit_processor(context.limit))
            result.message = " ".join(process.stderr.decode(errors="replace").split())[:300]
            result.status = process.returncode if process.returncode != -signal.SIGXCPU else None
        except subprocess.TimeoutExpired:
            pass
        spent = processor_time() - begin
        check_run(result, context)
        if result.nodes is not None:
            for check in task.checks:
                check(result, context)
            if task.check:
                task.check(result)
            if context.errors:
                find_error(result, context)
        verdict = verdict_of(result)
        kept = context.keep / f"{context.seed}-{number}"
        if kept.exists():
            shutil.rmtree(kept)
        if context.keeps_all or verdict in ("INSANE", "worse, said"):
            shutil.copytree(folder, kept)
    files = {task.input, task.output, "report.json", *task.files}
    way = way_of(result.report) if result.status == 0 and task.shape.kind == "surface" and task.command in ("fair", "fit") and not task.drag else None
    command = ["drag_session" if task.drag else "vspring", *(str(kept / word) if word in files else word for word in task.arguments)]
    return {"number": number, "kind": task.shape.kind, "family": task.shape.family, "detail": task.shape.detail, "how": task.how,
            "nodes": len(task.shape.nodes), "noise": task.noise / task.shape.size, "verdict": verdict, "status": result.status,
            "way": way, "outcome": result.report.get("outcome"), "reasons": [text for _, text in result.reasons], "message": result.message,
            "seconds": result.report.get("longest_call_seconds", spent), "work": work_of(result), "figures": result.figures,
            "options": task.options, "command": shlex.join(command)}


class Context:
    """What all tasks of a run have in common."""

    def __init__(self, seed, kind, program, sessions, limit, keep, keeps_all, errors):
        self.seed, self.kind, self.limit, self.keep, self.keeps_all, self.errors = seed, kind, limit, keep, keeps_all, errors
        self.program, self.sessions = (str(pathlib.Path(path).resolve()) for path in (program, sessions))


def numbers_of(options):
    """Those asked for, or the first N of a kind."""
    if options.only:
        return options.only
    fitting = (k for k in itertools.count(1) if options.kind in (None, *OF_THEIR_OWN, kind_of(options.seed, k)))
    return list(itertools.islice(fitting, options.count))


def run_all(numbers, context, jobs, tell):
    if jobs == 1:
        for number in numbers:
            tell(run_task(number, context))
        return
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        try:
            for done in concurrent.futures.as_completed([pool.submit(run_task, number, context) for number in numbers]):
                tell(done.result())
        except KeyboardInterrupt:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
