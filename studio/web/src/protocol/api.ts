// Questions to the program, each one function. What goes wrong is told in the program's own words.
import type { ExportAnswer, LibraryRules, PlaceAnswer, Problem, Project, Vec3, WhyAnswer } from "./types";
import { readLayers, type Axis, type Layers } from "./layers";
import { readSurfaces, type Surfaces } from "./surfaces";

export class ApiError extends Error {
  constructor(message: string, readonly status: number, readonly body: Record<string, unknown>) {
    super(message);
  }
}

/** What was asked of has been overtaken by an edit: what comes next answers better. */
export const isOvertaken = (error: unknown): boolean => error instanceof ApiError && error.status === 409;

async function ask<T>(address: string, body?: unknown, signal?: AbortSignal): Promise<T> {
  const answer = await fetch(address, {
    method: body === undefined ? "GET" : "POST",
    headers: body === undefined ? {} : { "Content-Type": "application/json" },
    body: body === undefined ? null : JSON.stringify(body),
    signal: signal ?? null,
    cache: "no-store",
  });
  const text = await answer.text();
  let found: Record<string, unknown> = {};
  try {
    found = JSON.parse(text) as Record<string, unknown>;
  } catch {
    if (answer.ok) throw new ApiError(`${address}: the answer is no JSON`, answer.status, {});
  }
  if (!answer.ok) throw new ApiError(String(found["error"] ?? answer.statusText), answer.status, found);
  return found as T;
}

export const askProject = () => ask<Project>("/api/project");
export const askSchema = (kind: "rules" | "scene") => ask<Record<string, unknown>>(`/api/schema/${kind}`);
export const askLibrary = async () => (await ask<{ rules: LibraryRules[] }>("/api/library")).rules;

export const sendEdit = (texts: Record<string, string>, signal: AbortSignal) =>
  ask<{ version: number; problems: Problem[] }>("/api/edit", { texts }, signal);

export const askWhy = (version: number, plant: number, node: number) =>
  ask<WhyAnswer>("/api/why", { version, plant, node });

export type Place =
  | { planting: string; seed: number; at_m: Vec3 }
  | { planting: string; at_m: Vec3 }
  | { camera: string; eye_m: Vec3; target_m: Vec3 };

export const askPlace = (place: Place) => ask<PlaceAnswer>("/api/place", place);

export const sendSave = (file: string, text: string, saved: string) =>
  ask<{ saved: string }>("/api/save", { file, text, saved });

export type ExportWish = { what: "glb" | "vdb" | "skeleton" } | { what: "image"; image: string };

export const askExport = (wish: ExportWish) => ask<ExportAnswer>("/api/export", wish);

async function askBytes(address: string, signal: AbortSignal): Promise<ArrayBuffer> {
  const answer = await fetch(address, { signal, cache: "no-store" });
  if (answer.ok) return answer.arrayBuffer();
  const body = (await answer.json().catch(() => ({}))) as Record<string, unknown>;
  throw new ApiError(String(body["error"] ?? answer.statusText), answer.status, body);
}

export const askSurfaces = async (version: number, signal: AbortSignal): Promise<Surfaces> =>
  readSurfaces(await askBytes(`/api/surfaces?version=${version}`, signal));

export const askLayers = async (version: number, axis: Axis, at_m: number, signal: AbortSignal): Promise<Layers> =>
  readLayers(await askBytes(`/api/layers?version=${version}&axis=${axis}&at=${at_m}`, signal));
