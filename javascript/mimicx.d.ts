/** A file as browsers have it, or the bytes of one; the suffix of the name says the format. */
export type MotionFile = {name: string; arrayBuffer(): Promise<ArrayBuffer>} | {name: string; bytes: Uint8Array | ArrayBuffer};

export interface Options {
  /** Formats to write the result in. */
  write?: ('.npz' | '.npy' | '.bvh' | '.glb' | '.mot' | '.sto' | '.csv')[];
  /** Aborting it ends the work; the promise is then rejected with its reason. */
  signal?: AbortSignal;
  /** First fit the motion to its keypoints, where it has any. Default: true. */
  fit?: boolean;
  /** Correct nothing before the plan. */
  as_is?: boolean;
  /** How to read the file, as the program's options: --up, --scale, --fps, --floor, --mass, --height, --body, --root,
   * --person. */
  up?: 'x' | 'y' | 'z' | '-x' | '-y' | '-z';
  scale?: number;
  fps?: number;
  floor?: number;
  mass?: number;
  height?: number;
  body?: 'file' | 'standard';
  root?: string;
  person?: number;
  limit_seconds?: number;
  /** Ground that is not flat (docs/scenes.md). */
  scene?: 'auto' | {plates: Record<string, unknown>[]};
  /** Any setting that `mimicx config` lists for plans and the simulation. */
  [setting: string]: unknown;
}

/** Numbers in C order. */
export interface NumberArray {
  shape: number[];
  data: Float64Array | Float32Array | BigInt64Array | Int32Array | Uint8Array;
}

export interface Result {
  /** Whether the body followed the motion to its end. */
  followed: boolean;
  /** Why it did not. */
  reason: string;
  /** docs/metrics.md, against the prepared reference. */
  metrics: Record<string, number | null>;
  /** The entry of manifest.json (docs/formats.md). */
  record: Record<string, unknown>;
  /** Arrays by name (docs/formats.md): poses, trans, joints, joint_torques, ground_wrenches … */
  arrays: Record<string, NumberArray>;
  /** The requested formats. */
  files: Record<string, Uint8Array>;
}

export interface Audit {
  evidence: string;
  passed: boolean;
  failures: string[];
  [more: string]: unknown;
}

/** Cleans a motion, as `mimicx plan` does. Rejected where no motion can be made. */
export function clean(file: MotionFile, options?: Options, onProgress?: (doing: string) => void): Promise<Result>;

/** Do the forces of a motion explain it? Could any? As `mimicx audit --json`. */
export function audit(file: MotionFile, options?: Options): Promise<Audit[]>;
