"""How an operator runs: what takes time in a thread, with progress and Esc; the change to the mesh at the end, all at once."""
import hashlib
import pickle
import threading
import time
import warnings

import bpy
import numpy as np

from .edited import Refused, made_even
from .modules import vspring

AT_ONCE = 0.3
"""Seconds that Blender waits before it shows progress."""


class Stopped(Exception):
    """Esc was pressed."""


class Job:
    """One call for one object. moving: the mask of the vertices that may move."""

    kept = {}
    """Results of the last run by what was asked for: a change of strength alone computes nothing."""

    def __init__(self, edited, mirrors, moving, call, *arguments, **options):
        self.edited, self.mirrors, self.moving = edited, mirrors, moving
        self.call, self.arguments, self.options = call, arguments, options
        self.key = hashlib.blake2b(pickle.dumps((call.__name__, arguments, options))).digest()

    def run(self, progress):
        if self.key not in Job.kept:
            with warnings.catch_warnings():  # the report has them
                warnings.simplefilter("ignore", vspring.Warning)
                Job.kept[self.key] = self.call(*self.arguments, **self.options, progress=progress)
        self.positions, self.report = Job.kept[self.key]

    def put(self, strength):
        """Returns how many vertices moved, and how far at most."""
        before = self.edited.vertices
        after = made_even(self.positions.copy(), self.moving, self.mirrors)
        if strength < 1:
            after = (before + strength * (after.astype(float) - before)).astype(np.float32)
        moves = np.linalg.norm(after.astype(float) - before, axis=1)
        return self.edited.put(after), moves.max(initial=0)


def edited_objects(context):
    """Those in Edit Mode, one for each mesh."""
    return [thing for thing in context.objects_in_mode_unique_data if thing.type == 'MESH']


def warn_of_scale(operator, things):
    for thing in things:
        scale = np.abs(thing.matrix_world.to_scale())
        if scale.max() > 1.001 * scale.min():
            operator.report({'WARNING'}, f"{thing.name}: its scale is uneven, and the shape is made fair as if it were not. "
                            "Apply the scale first (Ctrl A) to make fair what is seen")


class EditModeOperator:
    """What all have in common."""

    bl_options = {'REGISTER', 'UNDO'}

    @classmethod
    def poll(cls, context):
        if context.mode != 'EDIT_MESH':
            cls.poll_message_set("Go to Edit Mode of a mesh")
            return False
        return True


class Running(EditModeOperator):
    """Calls of the library for every object in Edit Mode with something selected.

    An operator says by job_of(thing, context) what to call; it raises Refused.
    """

    strength: bpy.props.FloatProperty(name="Strength", description="How much of the change is made", default=1, min=0, max=1, subtype='FACTOR')

    @classmethod
    def poll(cls, context):
        if not super().poll(context):
            return False
        if not any(thing.data.total_vert_sel for thing in edited_objects(context)):
            cls.poll_message_set("Select the vertices that are to move")
            return False
        return True

    def execute(self, context):
        if not self.begin(context):
            return {'CANCELLED'}
        self.work()
        return self.end(context)

    def invoke(self, context, event):
        if not self.begin(context):
            return {'CANCELLED'}
        self.worker = threading.Thread(target=self.work, name="vspring", daemon=True)
        self.worker.start()
        self.worker.join(AT_ONCE)
        if not self.worker.is_alive():
            return self.end(context)
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self.timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {'RUNNING_MODAL'}

    def modal(self, context, event):
        if event.type == 'ESC' and event.value == 'PRESS':
            self.is_stopped = True
        elif event.type == 'TIMER':
            if not self.worker.is_alive():
                context.window_manager.event_timer_remove(self.timer)
                context.window_manager.progress_end()
                context.workspace.status_text_set(None)
                return self.end(context)
            context.window_manager.progress_update(self.percent)
            context.workspace.status_text_set("Stopping" if self.is_stopped else f"{self.bl_label}: {self.percent} %. Esc: stop, and leave the mesh as it was")
        return {'RUNNING_MODAL'}

    def cancel(self, context):
        """Blender ends, or opens another file."""
        self.is_stopped = True

    def begin(self, context):
        self.percent, self.is_stopped, self.failure = 0, False, None
        try:
            chosen = [thing for thing in edited_objects(context) if thing.data.total_vert_sel]
            self.jobs = [self.job_of(thing, context) for thing in chosen]
        except (Refused, vspring.Error) as refused:
            self.report({'ERROR'}, str(refused))
            return False
        warn_of_scale(self, chosen)
        return True

    def work(self):
        """Beside Blender's own thread: touches arrays only."""
        wanted = {job.key for job in self.jobs}
        Job.kept = {key: result for key, result in Job.kept.items() if key in wanted}
        for done, job in enumerate(self.jobs):
            def tell(now):
                self.percent = int(100 * (done + now.fraction) / len(self.jobs))
                if self.is_stopped:
                    raise Stopped

            try:
                job.run(tell)
            except Stopped:
                return
            except Exception as failure:
                self.failure = job, failure
                return

    def end(self, context):
        if self.is_stopped:
            self.report({'INFO'}, "Stopped; the mesh is as it was")
            return {'CANCELLED'}
        if self.failure:
            job, failure = self.failure
            if not isinstance(failure, vspring.Error):
                raise failure
            self.report({'ERROR'}, f"{job.edited.object.name}: {failure}{self.advice(failure)}")
            return {'CANCELLED'}
        changed = [job.edited.object.name for job in self.jobs if not job.edited.is_edited_still()]
        if changed:
            self.report({'ERROR'}, f"{changed[0]}: it was changed meanwhile, or left Edit Mode. Start again")
            return {'CANCELLED'}
        count, furthest = 0, 0.0
        for job in self.jobs:
            moved, move = job.put(self.strength)
            count, furthest = count + moved, max(furthest, move)
            for warning in job.report.warnings:
                self.report({'WARNING'}, f"{job.edited.object.name}: {warning}")
        if count:
            self.report({'INFO'}, f"{count} {'vertex' if count == 1 else 'vertices'} moved, by {furthest:.3g} at most")
        else:
            self.report({'WARNING'}, "No vertex moved: what is selected is fair already, or held (see Open Edges, Ends and Pins)")
        return {'FINISHED'}

    def advice(self, failure):
        """What to do in Blender, behind a message of the library."""
        return ""
