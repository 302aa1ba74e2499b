# Example scenes, and any other file in scenes/: each is run and drawn.


rule simulate_scene:
    input:
        lambda wildcards: scene_files(wildcards.scene),
    output:
        "results/scenes/{scene}.parquet",
    log:
        "results/logs/simulate_scene/{scene}.log",
    benchmark:
        "results/benchmarks/simulate_scene/{scene}.tsv"
    conda:
        "../../envs/simulate.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("simulate"),
        file=lambda wildcards: scene_files(wildcards.scene)[0],
    message:
        "simulate scene {wildcards.scene}"
    shell:
        "sedfiber simulate {params.file} -o {output} > {log} 2>&1"


rule plot_scene:
    input:
        trajectory="results/scenes/{scene}.parquet",
    output:
        svg=report(
            "results/figures/scenes/{scene}.svg",
            caption="../report/scene.rst",
            category="6. Beyond the study",
            labels={"figure": "More: scene {scene}"},
        ),
        png="results/figures/scenes/{scene}.png",
    log:
        "results/logs/plot_scene/{scene}.log",
    benchmark:
        "results/benchmarks/plot_scene/{scene}.tsv"
    conda:
        "../../envs/figures.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code_of("plot_scene"),
        title=lambda wildcards: wildcards.scene.replace("_", " "),
    message:
        "draw scene {wildcards.scene}"
    shell:
        "sedfiber plot_scene {input.trajectory} --title {params.title:q}"
        " --svg {output.svg} --png {output.png} > {log} 2>&1"


rule tabulate_scene_audit:
    input:
        trajectories=expand("results/scenes/{scene}.parquet", scene=SCENES),
    output:
        "results/tables/scene_audit.csv",
    log:
        "results/logs/tabulate_scene_audit.log",
    benchmark:
        "results/benchmarks/tabulate_scene_audit.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("tabulate_audit"),
    message:
        "tabulate what the scenes left out"
    shell:
        "sedfiber tabulate_audit {input.trajectories} -o {output} > {log} 2>&1"


rule scenes:
    input:
        expand("results/figures/scenes/{scene}.png", scene=SCENES),
        rules.tabulate_scene_audit.output,


rule compare_third_dimension:
    output:
        table="results/tables/third_dimension.csv",
        growth="results/tables/third_dimension_growth.csv",
    log:
        "results/logs/compare_third_dimension.log",
    benchmark:
        "results/benchmarks/compare_third_dimension.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=10,
    params:
        code=code_of("compare_third_dimension"),
        B=config["third_dimension"]["B"],
        options=STUDY.third_dimension_options,
    message:
        "find where the third dimension begins to matter"
    shell:
        "sedfiber compare_third_dimension --B {params.B} {params.options}"
        " -o {output.table} --growth {output.growth} > {log} 2>&1"


use rule plot_problem as plot_third_dimension with:
    input:
        table="results/tables/third_dimension.csv",
        growth="results/tables/third_dimension_growth.csv",
    output:
        **drawn("third_dimension"),
    log:
        "results/logs/plot_third_dimension.log",
    benchmark:
        "results/benchmarks/plot_third_dimension.tsv"
    params:
        code=code_of("plot_third_dimension"),
        call=drawn_from("plot_third_dimension", "{table}", "--growth {growth}"),
    message:
        "draw where the third dimension begins to matter"


rule third_dimension:
    input:
        rules.plot_third_dimension.output,


rule measure_effects:
    output:
        "results/tables/effects.csv",
    log:
        "results/logs/measure_effects.log",
    benchmark:
        "results/benchmarks/measure_effects.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        code=code_of("measure_effects"),
        options=STUDY.effects_options,
    message:
        "measure cost and influence of every effect"
    shell:
        "sedfiber measure_effects {params.options} -o {output} > {log} 2>&1"


use rule plot_problem as plot_effects with:
    input:
        table="results/tables/effects.csv",
    output:
        **drawn("effects"),
    log:
        "results/logs/plot_effects.log",
    benchmark:
        "results/benchmarks/plot_effects.tsv"
    params:
        code=code_of("plot_effects"),
        call=drawn_from("plot_effects", "{table}"),
    message:
        "draw cost and influence of every effect"


rule benchmark_parts:
    output:
        "results/tables/parts_against_fused_kernel.csv",
    log:
        "results/logs/benchmark_parts.log",
    benchmark:
        "results/benchmarks/benchmark_parts.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code_of("benchmark_parts"),
    message:
        "time the study's scene against a kernel written for it alone"
    shell:
        "sedfiber benchmark_parts -o {output} > {log} 2>&1"


rule effects:
    input:
        rules.plot_effects.output,
        rules.benchmark_parts.output,
